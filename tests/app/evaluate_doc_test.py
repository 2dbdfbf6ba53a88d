"""docs/recommendation.md shows what the program prints: each line of a block behind its command, and
every figure of its text."""

import pathlib
import re
import sys

from shown_output import check_blocks, figure

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
page = (source / "docs/recommendation.md").read_text(encoding="utf-8")
outputs, lines = check_blocks(program, source, page)
assert len(outputs) >= 3 and lines > 30, "the page shows too little"

printed = {word for output in outputs.values() for one in output for word in figure.findall(one)}
prose = "\n".join(line for line in page.splitlines() if not line.startswith("    "))
stated = re.findall(r"(?<![\w.])\d+\.\d+(?![\w.])", prose)
missing = [word for word in stated if word not in printed and not any(
    abs(float(word) - float(other)) <= 2.001 * 10.0**-len(word.partition(".")[2])
    and len(other.partition(".")[2]) == len(word.partition(".")[2]) for other in printed)]
assert stated and not missing, f"figures that no command prints: {missing}"
print(f"{lines} lines and {len(stated)} figures, as printed")
