"""Does what docs/quickstart.md says, in a folder of its own, and finds every line of output that the
page shows.

usage: quickstart_test.py PROGRAM SOURCE_FOLDER
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import markdown

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PAGE = SOURCE / "docs/quickstart.md"
# What a clone on a new machine does: .ci/fresh-machine runs it.
ELSEWHERE = ("./dev run", "export PATH=")
FIGURE = re.compile(r"\d+(?:\.\d+)?")


def values_of_the_table():
    """{(table, key): value}, with no name for the top of the file."""
    rows = re.findall(r"^\| (?:top|`(\[\[?[\w.]+\]\]?)`) \| `(\w+)` \| `(.+)` \|$", PAGE.read_text(encoding="utf-8"),
                      re.M)
    assert len(rows) > 15, "the table of values is not where it was"
    return {(table, key): value for table, key, value in rows}


def fill_in(case, values):
    """Replaces the blanks by the page's values: all of them, and no others."""
    table, lines = "", case.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines):
        header, blank = re.match(r"\[\[?[\w.]+\]\]?$", line), re.match(r'(\w+) = "\?"', line)
        table = header.group() if header else table
        if blank:
            lines[number] = f"{blank.group(1)} = {values.pop((table, blank.group(1)))}"
    assert not values, f"no blanks for {values}"
    case.write_text("\n".join(lines) + "\n", encoding="utf-8")


def same(shown, printed):
    """Whether two lines differ by no more than another processor's rounding."""
    if FIGURE.sub("#", shown).split() != FIGURE.sub("#", printed).split():
        return False
    return all(abs(float(x) - float(y)) <= 2.001 * 10.0**-len(x.partition(".")[2]) * ("." in x)
               for x, y in zip(FIGURE.findall(shown), FIGURE.findall(printed)))


def main():
    code = [line for _, line in markdown.split(PAGE)[1] if line.strip()]
    printed, shown, commands = [], [], 0
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
        for line in code:
            if line.startswith(ELSEWHERE):
                continue
            if not line.startswith("boresight "):
                shown.append(line.strip())
                continue
            words = [str(PROGRAM), *shlex.split(line)[1:]]
            if "new" not in words and commands == 1:
                blank = subprocess.run([*words], cwd=folder, env=environment, text=True,
                                       capture_output=True, check=False)
                assert blank.returncode == 2, "blanks were taken"
                printed += blank.stderr.splitlines()
                fill_in(pathlib.Path(folder) / "my-antenna/case.toml", values_of_the_table())
            result = subprocess.run(words, cwd=folder, env=environment, text=True,
                                    capture_output=True, check=False)
            assert result.returncode == 0, f"{line}: exit code {result.returncode}\n{result.stderr}"
            printed += result.stdout.splitlines()
            commands += 1
    assert commands >= 5 and len(shown) > 12, "the page shows less than it did"
    lines = {line.strip() for line in printed}
    missing = [line for line in shown
               if line not in lines and not any(same(line, other) for other in lines)]
    assert not missing, "docs/quickstart.md shows what is not printed:\n" + "\n".join(missing)
    print(f"{commands} commands, {len(shown)} lines of output as printed")


if __name__ == "__main__":
    main()
