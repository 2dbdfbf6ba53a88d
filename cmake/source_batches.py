#!/usr/bin/env python3
"""Puts source files into batches that can be compiled as one file each.

Most of the time that a source file takes goes into the headers it reads and the templates it makes of
them, Eigen above all; a batch pays for that once. Files may share a batch where none uses a word that
another declares for itself alone, in an unnamed namespace.

  source_batches.py KEPT LARGEST FILE...

prints a line "batch file" for each FILE, no batch being larger than LARGEST. The file KEPT remembers the
batches: a file stays where it was as long as it can, so that an edit does not compile others again.
"""

import pathlib
import re
import sys

# A declaration at the start of a line: the name before the first of (, =, {, [ and ;.
DECLARED = re.compile(r"^(?!#|//|namespace\b|using namespace\b|\}|template\b|[A-Z_]+\()"
                      r"[^\s][^({=;\[]*?(\w+)\s*[({=;\[]")
TYPE = re.compile(r"^(?:struct|class|enum class|enum|union) (\w+)")
# GoogleMock's matchers are declared by a macro, and classes are made of their names.
MATCHER = re.compile(r"^MATCHER\w*\((\w+)")
# Of members, after a dot or an arrow, there is no doubt whose they are.
WORD = re.compile(r"(?<!\.)(?<!->)\b[A-Za-z_]\w*")


def local_names(text):
    """What a file declares for itself alone: in its unnamed namespace, aliases aside, which may be
    repeated."""
    names, inside = set(), False
    for line in text.splitlines():
        if line.startswith("namespace {"):
            inside = True
        elif line.startswith("}  // namespace"):
            inside = False
        elif inside and not line.startswith("using "):
            for pattern in (TYPE, MATCHER, DECLARED):
                if match := pattern.match(line):
                    names.add(match.group(1))
                    break
    return names


class Batch:
    """Files that can be read one behind the other."""

    def __init__(self):
        self.members, self.taken, self.used = [], set(), set()

    def admits(self, names, words):
        return not names & self.used and not words & self.taken

    def add(self, source, names, words):
        self.members.append(source)
        self.taken |= names
        self.used |= words


def batches(sources, largest, kept=None):
    """Of each batch its sources, in order. kept: of a source the number of the batch it was in."""
    kept = kept or {}
    made = [Batch() for _ in range(max(kept.values(), default=-1) + 1)]
    for source in sorted(sources, key=lambda source: source not in kept):
        text = pathlib.Path(source).read_text(encoding="utf-8")
        names, words = local_names(text), set(WORD.findall(text))
        first = made[kept[source]:kept[source] + 1] if source in kept else []
        for batch in [*first, *made]:
            if len(batch.members) < largest and batch.admits(names, words):
                break
        else:
            made.append(batch := Batch())
        batch.add(source, names, words)
    return [batch.members for batch in made]


def main():
    memory, largest, sources = pathlib.Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]
    kept = {}
    if memory.exists():
        for line in memory.read_text(encoding="utf-8").splitlines():
            number, source = line.split(" ", 1)
            if source in sources:
                kept[source] = int(number)
    lines = "".join(f"{number} {source}\n" for number, members in enumerate(batches(sources, largest, kept))
                    for source in members)
    memory.parent.mkdir(parents=True, exist_ok=True)
    memory.write_text(lines, encoding="utf-8")
    print(lines, end="")


if __name__ == "__main__":
    main()
