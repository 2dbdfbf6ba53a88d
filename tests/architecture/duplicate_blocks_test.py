"""No block of 12 lines or more stands twice in the sources.

Lines count that say something: blank lines, comments, includes, using declarations and lines of
braces or brackets alone do not; blanks at the ends do not count either.

usage: duplicate_blocks_test.py SOURCE_FOLDER
"""

import pathlib
import re
import subprocess
import sys
import tempfile

LENGTH = 12
SUFFIXES = {".cpp", ".hpp", ".py", ".js", ".ts"}
FOLDERS = ("numerics", "plant", "identification", "control", "design", "io", "app", "bench", "tests", "docs", "python",
           "web", "examples")
SILENT = re.compile(r"[\s{}()\[\];,]*$|//|/\*|\*|#(?!if|else|endif)|using |namespace |\"\"\"|import |from ")

# Pairs of files that share a block on purpose, with the reason.
ALLOWED = {
    ("tests/data/", "tests/data/"): "data made by scripts of one kind",
}


def sources(root):
    """Files that the version control knows, so that nothing built counts."""
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True,
                            text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        names = listed.stdout.split("\0")
    else:
        names = [str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]
    return sorted(name for name in names
                  if pathlib.PurePath(name).suffix in SUFFIXES
                  and (root / name).is_file()
                  and (name.split("/")[0] in FOLDERS or "/" not in name))


def telling_lines(path):
    """[(number, line)] of the lines that count."""
    lines, quoted = [], False
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        if path.suffix == ".py" and line.count('"""') % 2 == 1:
            quoted = not quoted
            continue
        if not quoted and not SILENT.match(line.strip()):
            lines.append((number, " ".join(line.split())))
    return lines


def duplicates(root):
    """[(file, first line, last line, other file, its first line)], each block once and whole."""
    seen, found = {}, []
    for name in sources(root):
        lines = telling_lines(root / name)
        open_block = None  # the duplicate that the last window belonged to
        for i in range(len(lines) - LENGTH + 1):
            window = tuple(text for _, text in lines[i:i + LENGTH])
            first = seen.setdefault(window, (name, i, lines[i][0]))
            if first[0] == name and i - first[1] < LENGTH:
                open_block = None
                continue
            last = lines[i + LENGTH - 1][0]
            if open_block and open_block[3] == first[0] and open_block[5] == first[1] - 1:
                open_block[2], open_block[5] = last, first[1]
            else:
                open_block = [name, lines[i][0], last, first[0], first[2], first[1]]
                found.append(open_block)
    return [tuple(block[:5]) for block in found]


def allowed(block):
    return any(block[0].startswith(one) and block[3].startswith(other)
               or block[0].startswith(other) and block[3].startswith(one)
               for one, other in ALLOWED)


def check_itself():
    """A copied block must be seen, one line less must not."""
    lines = [f"  value{i} = work({i});\n" for i in range(LENGTH)]
    for count, blocks in ((LENGTH, 1), (LENGTH - 1, 0)):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "app").mkdir()
            for name in ("a", "b"):
                (pathlib.Path(folder) / f"app/{name}.cpp").write_text(
                    f"int {name} = 1;\n\n" + "".join(lines[:count]) + f"  // end of {name}\n}}\n")
            assert len(duplicates(pathlib.Path(folder))) == blocks, (count, blocks)


if __name__ == "__main__":
    check_itself()
    blocks = [block for block in duplicates(pathlib.Path(sys.argv[1])) if not allowed(block)]
    for file, first, last, other, line in blocks:
        print(f"{file}:{first}: lines {first} to {last} stand in {other}:{line} too")
    sys.exit(1 if blocks else 0)
