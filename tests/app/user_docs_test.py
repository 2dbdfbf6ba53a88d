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
PAGES = {"control-structures": 30, "specifications": 3, "limit-cycles": 12, "records-only": 18,
         "structural-modes": 9}
DONE, INFEASIBLE = 0, 3


def printed_by(command, folder):
    """All lines that a command prints in a folder where the project's cases are."""
    words = [name for word in shlex.split(command)[1:] for name in
             (sorted(str(path.relative_to(SOURCE)) for path in SOURCE.glob(word))
              if "*" in word else [word])]
    result = subprocess.run([str(PROGRAM), *words], cwd=folder, capture_output=True, text=True,
                            check=False)
    assert result.returncode in (DONE, INFEASIBLE), f"{command}: {result.stderr}"
    return (result.stdout + result.stderr).splitlines()


def check(page, least, outputs, folder):
    """How many lines of output a page shows, each as its command prints it. Later commands find what
    earlier ones have written into the folder."""
    command, shown = None, 0
    for line in (SOURCE / f"docs/{page}.md").read_text(encoding="utf-8").splitlines():
        text = line.strip()
        if not line.startswith("    ") or not text:
            continue
        if text.startswith("boresight "):
            command = text
            continue
        assert command is not None, f"{page}: no command stands before: {line}"
        if command not in outputs:
            outputs[command] = printed_by(command, folder)
        assert not not_printed([text], outputs[command]), \
            f"{page}: {command} does not print: {line}"
        shown += 1
    assert shown >= least, f"{page} shows {shown} lines"
    return shown


def main():
    outputs = {}
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "cases").symlink_to(SOURCE / "cases")
        lines = sum(check(page, least, outputs, folder) for page, least in PAGES.items())
    print(f"{lines} lines of {len(outputs)} commands, as printed")


if __name__ == "__main__":
    main()
