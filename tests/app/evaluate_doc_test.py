"""docs/recommendation.md shows what the program prints: each line of a block behind its command, and
every figure of its text."""

import pathlib
import re
import shlex
import subprocess
import sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
page = (source / "docs/recommendation.md").read_text(encoding="utf-8")
figure = re.compile(r"\d+(?:\.\d+)?")


def same(shown, printed):
    """Whether two lines differ by no more than another processor's rounding: two units of the last
    digit of a number."""
    if figure.sub("#", shown).split() != figure.sub("#", printed).split():
        return False
    for x, y in zip(figure.findall(shown), figure.findall(printed)):
        places = min(len(word.partition(".")[2]) for word in (x, y))
        if abs(float(x) - float(y)) > (2.001 * 10.0**-places if places else 0.0):
            return False
    return True


def run(command):
    words = shlex.split(command)
    assert words[0] == "boresight", command
    arguments = []
    for word in words[1:]:
        arguments += sorted(str(p.relative_to(source)) for p in source.glob(word)) \
            if "*" in word else [word]
    result = subprocess.run([program, *arguments], cwd=source, capture_output=True, text=True,
                            check=True)
    return result.stdout.splitlines()


outputs, current, lines = {}, None, 0
for line in page.splitlines():
    if not line.startswith("    "):
        continue
    text = line.strip()
    if text.startswith("boresight "):
        current = outputs.setdefault(text, None) or run(text)
        outputs[text] = current
    elif text:
        assert current is not None, f"no command stands before: {line}"
        assert any(same(text, one) for one in current), f"the program does not print: {line}"
        lines += 1
assert len(outputs) >= 3 and lines > 30, "the page shows too little"

printed = {word for output in outputs.values() for one in output for word in figure.findall(one)}
prose = "\n".join(line for line in page.splitlines() if not line.startswith("    "))
stated = re.findall(r"(?<![\w.])\d+\.\d+(?![\w.])", prose)
missing = [word for word in stated if word not in printed and not any(
    abs(float(word) - float(other)) <= 2.001 * 10.0**-len(word.partition(".")[2])
    and len(other.partition(".")[2]) == len(word.partition(".")[2]) for other in printed)]
assert stated and not missing, f"figures that no command prints: {missing}"
print(f"{lines} lines and {len(stated)} figures, as printed")
