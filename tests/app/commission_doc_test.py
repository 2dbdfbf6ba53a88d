"""docs/commissioning.md shows what the program prints: each line of a block behind its command."""

import pathlib
import sys

from shown_output import check_blocks

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
page = (source / "docs/commissioning.md").read_text(encoding="utf-8")
outputs, lines = check_blocks(program, source, page)
assert len(outputs) == 1 and lines > 25, "the page shows too little"
print(f"{lines} lines, as printed")
