"""Every name that docs/extending.md puts beside a file stands in that file.

usage: extending_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys


def main(root):
    page = (root / "docs/extending.md").read_text(encoding="utf-8")
    faults, names = [], 0
    for file, work in re.findall(r"^\| `([\w./]+)` \| (.*) \|$", page, re.M):
        path = root / file
        if not path.is_file():
            faults.append(f"{file}: no such file")
            continue
        # A function may be declared in the header of the same name.
        text = "".join(one.read_text(encoding="utf-8")
                       for one in (path, path.with_suffix(".hpp")) if one.is_file())
        for name in re.findall(r"`([\w\[\]]+)`", work):
            names += 1
            if not re.search(rf"{re.escape(name)}(?!\w)", text):
                faults.append(f"{file} has no {name}")
    assert names > 25, "the page names less than it did"
    print("\n".join(faults) or f"{names} names are where the page says")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
