"""Every line of output that README.md shows is one the program prints, and every command it names
exists."""

import pathlib
import re
import subprocess
import sys
import tempfile

from shown_output import not_printed

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
readme = (source / "README.md").read_text()


MOST_LINES = 200


def check(sections, *arguments):
    """The lines of output that sections of README.md show are those of the command."""
    printed = subprocess.run([program, *arguments], cwd=source, capture_output=True, text=True,
                             check=True).stdout.splitlines()
    text = "\n".join(readme.split(f"# {section}\n")[1].split("\n## ")[0] for section in sections)
    shown = [line[4:].strip() for line in text.splitlines() if line.startswith("    ")]
    shown = [line for line in shown if line and not line.startswith(("./dev", "boresight "))]
    missing = not_printed(shown, printed)
    # Title, card of the result and 60 lines: what does not fit is for --details.
    assert len(printed) <= 3 + 16 + 60, f"{arguments[0]} prints {len(printed)} lines"
    assert len(shown) > 5, f"README.md shows no output in {sections}"
    assert not missing, "README.md shows what the program does not print:\n" + "\n".join(missing)
    return len(shown)


case = "cases/dss14-70m/case.toml"
lines = check(("Tuning",), "tune", case, "--structure", "PI", "--structure", "DPF+C")
with tempfile.TemporaryDirectory() as folder:
    report = f"{folder}/redesign.json"
    lines += check(("Boresight", "What the main job prints"), "redesign", case, "--json", report)
    # The controller that the command tunes without: tests/app/tune/controller_study_test.cpp.
    lines += check(("Simulated tests",), "simulate", case, "slosh", "slow-ramp", "tracking",
                   "--folder", folder, "--gains", report)

# The card, a picture and the two commands come first.
firsts = [readme.index(first) for first in ("\n      Recommended ", "\n![", "\n## Two commands\n")]
assert firsts == sorted(firsts) and readme.count("\n## ", 0, firsts[-1]) == 0
assert readme.count("\n") <= MOST_LINES, f"README.md has {readme.count(chr(10))} lines"

help_text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
for command in re.findall(r"`boresight (\w+) CASE`", readme):
    assert command in help_text, f"README.md names the command {command}, the program has none"
for path in re.findall(r"`((?:cases|docs|tests|bench)/[\w./-]+)`", readme):
    assert (source / path).exists(), f"README.md names {path}, which is not there"
print(f"{lines} lines of output, as printed")
