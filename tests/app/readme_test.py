"""Every line of output that README.md shows is one the program prints, and every command it names
exists."""

import pathlib
import re
import subprocess
import sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
readme = (source / "README.md").read_text()

printed = subprocess.run(
    [program, "redesign", "cases/dss14-70m/case.toml"],
    cwd=source, capture_output=True, text=True, check=True).stdout.splitlines()
printed = {line.strip() for line in printed}
section = readme.split("## What the main job prints")[1].split("\n## ")[0]
shown = [line[4:].strip() for line in section.splitlines() if line.startswith("    ")]
shown = [line for line in shown if line]
missing = [line for line in shown if line not in printed]
assert len(shown) > 30, "README.md shows no output"
assert not missing, "README.md shows what the program does not print:\n" + "\n".join(missing)

help_text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
for command in re.findall(r"`boresight (\w+) CASE`", readme):
    assert command in help_text, f"README.md names the command {command}, the program has none"
for path in re.findall(r"`((?:cases|docs|tests|bench)/[\w./-]+)`", readme):
    assert (source / path).exists(), f"README.md names {path}, which is not there"
print(f"{len(shown)} lines of output, as printed")
