"""The pages for users show what the program prints: each line of an indented block behind its command, on
either output.

usage: user_docs_test.py PROGRAM SOURCE_FOLDER
"""

import pathlib
import shlex
import subprocess
import sys
import tempfile

from shown_output import not_printed

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
# The page and how many lines of output it shows at least.
PAGES = {"control-structures": 30, "specifications": 3, "limit-cycles": 12, "records-only": 13,
         "structural-modes": 9}
DONE, INFEASIBLE = 0, 3


def printed_by(command):
    """All lines that a command prints in a folder of its own, where the project's cases are."""
    words = shlex.split(command)[1:]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "cases").symlink_to(SOURCE / "cases")
        words = [name for word in words for name in
                 (sorted(str(path.relative_to(SOURCE)) for path in SOURCE.glob(word))
                  if "*" in word else [word])]
        result = subprocess.run([str(PROGRAM), *words], cwd=folder, capture_output=True, text=True,
                                check=False)
    assert result.returncode in (DONE, INFEASIBLE), f"{command}: {result.stderr}"
    return (result.stdout + result.stderr).splitlines()


def main():
    outputs, checked = {}, 0
    for page, least in PAGES.items():
        command, shown = None, []
        for line in (SOURCE / f"docs/{page}.md").read_text(encoding="utf-8").splitlines():
            text = line.strip()
            if not line.startswith("    ") or not text:
                continue
            if text.startswith("boresight "):
                command = text
                outputs.setdefault(command, None)
                continue
            assert command is not None, f"{page}: no command stands before: {line}"
            if outputs[command] is None:
                outputs[command] = printed_by(command)
            assert not not_printed([text], outputs[command]), \
                f"{page}: {command} does not print: {line}"
            shown.append(text)
        assert len(shown) >= least, f"{page} shows {len(shown)} lines"
        checked += len(shown)
    print(f"{checked} lines of {len(outputs)} commands, as printed")


if __name__ == "__main__":
    main()
