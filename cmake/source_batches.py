#!/usr/bin/env python3
"""Puts source files into batches that are compiled as one file each.

Most of the time that a source file takes goes into the headers it reads and the templates it makes of
them, Eigen above all; a batch pays for that once. A batch is what its files include, then their texts,
each under the name and the line numbers of its file. What a file declares for itself alone, in an unnamed
namespace, is given a name of its own there, so that names do not clash. Where that cannot be done (a name
that is also a member's, or a header's) files share a batch only if none uses that word of another.

  source_batches.py FOLDER LARGEST FILE...

writes the batches, of at most LARGEST files, as FOLDER/batch_N.cpp and prints their names, a line each.
FOLDER/kept.txt remembers them: a file stays where it was as long as it can, so that an edit does not
compile others again.
"""

import pathlib
import re
import sys

# A declaration at the start of a line: the name before the first of (, =, {, [ and ;.
DECLARED = re.compile(r"^(?!#|//|namespace\b|using namespace\b|\}|template\b|[A-Z_]+\()"
                      r"(?:\[\[[^\]]*\]\]\s*)?[^\s][^({=;\[]*?(\w+)\s*[({=;\[]")
TYPE = re.compile(r"^(?:struct|class|enum class|enum|union) (\w+)")
# Of `constexpr double step = 0.01, length = 90.0;` both names.
CONSTANT = re.compile(r"(?<![.\w])(\w+) = ")
# GoogleMock's matchers are declared by a macro, and classes are made of their names.
MATCHER = re.compile(r"^MATCHER\w*\((\w+)")
# Of what stands after a dot, an arrow or a scope there is no doubt whose it is.
WORD = re.compile(r"(?<!\.)(?<!->)(?<!::)\b[A-Za-z_]\w*")
# Words of the language that a declaration may show instead of a name, and what GoogleTest looks for
# by this name beside a type, so that each is an overload.
NOT_NAMES = {"PrintTo", "bool", "char", "double", "float", "int", "long", "short", "unsigned", "void"}


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
            if line.startswith("constexpr "):
                names |= set(CONSTANT.findall(line))
    return names - NOT_NAMES


# Macros that make text or other names of what they are given.
PASTING = re.compile(r"^(?:TEST|TYPED_TEST|INSTANTIATE_|MATCHER|BENCHMARK)\w*\(.*$", re.M)
QUALIFIED = re.compile(r"(?:\.|->|::)\s*([A-Za-z_]\w*)")
# Includes of the head of a file; what stands between #if and #endif is left to the file.
INCLUDE = re.compile(r'^#include (<[^>]+>|"[^"]+")', re.M)
CONDITION = re.compile(r"^#\s*if.*?^#\s*endif", re.M | re.S)
# What is set for the headers that follow must not be set for those of other files, nor come behind them.
SETS_FOR_HEADERS = re.compile(r"^#\s*(?:define|undef)\b[\s\S]*^#\s*include\b.*", re.M)
# fmt/ranges.h does not do behind nlohmann/json.hpp what it does before it.
FIRST = "<fmt/ranges.h>"


# A piece of C++ that is read as a whole: what may hold words that are no names, a number, a name with what
# says whose it is.
PIECE = re.compile(r"""//[^\n]* | /\*.*?\*/ | ^\#\s*include[^\n]*
                       | R"(?P<mark>\w*)\(.*?\)(?P=mark)" | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*'
                       | \b\d[\w'.]* | (?:\.|->|::)\s*[A-Za-z_]\w* | (?P<name>\b[A-Za-z_]\w*)""",
                   re.M | re.S | re.X)
CLASS = re.compile(r"\b(?:struct|class|union)\s+(\w+)([^;{()]*)\{")
# Members of which classes a file defines: what stands before the last scope of a definition.
DEFINES_MEMBERS = re.compile(r"^\w[^;={(]*?((?:\w+::)+)~?\w+\(", re.M)
NOT_SOURCES = {".git", "build", "web"}


def without_comments(text):
    return re.sub(r"//.*", "", text)


def declared_names(header):
    """Names that a header declares at the level of a namespace."""
    names = set()
    for line in without_comments(header).splitlines():
        for pattern in (TYPE, DECLARED):
            if match := pattern.match(line):
                names.add(match.group(1))
                break
    return names


def class_words(text):
    """Of each class that a text declares, the words between its braces, and those that name its bases."""
    words = {}
    for match in CLASS.finditer(text):
        depth, at = 1, match.end()
        while depth and at < len(text):
            depth += {"{": 1, "}": -1}.get(text[at], 0)
            at += 1
        own, bases = words.setdefault(match[1], (set(), set()))
        own.update(WORD.findall(text[match.end():at]))
        bases.update(WORD.findall(match[2]))
    return words


class Headers:
    """The project's headers, by the names they are included by."""

    def __init__(self, root):
        self.names, self.included, self.classes = {}, {}, {}
        folders = [folder for folder in root.iterdir() if folder.is_dir() and folder.name not in NOT_SOURCES]
        for header in (header for folder in folders for header in folder.rglob("*.hpp")):
            place = header.relative_to(root).as_posix()
            text = header.read_text(encoding="utf-8")
            name = f'"{place.removeprefix("tests/")}"' if place.startswith("tests/") else f"<boresight/{place}>"
            self.names[name], self.included[name] = declared_names(text), INCLUDE.findall(text)
            for of_class, (words, bases) in class_words(without_comments(text)).items():
                of_all = self.classes.setdefault(of_class, (set(), set()))
                of_all[0].update(words)
                of_all[1].update(bases)

    def declared(self, text):
        """Names that the project's headers declare to one who reads the text, with the members of classes
        that the text defines functions of."""
        open_ones, seen, names = INCLUDE.findall(text), set(), set()
        while open_ones:
            name = open_ones.pop()
            if name in self.names and name not in seen:
                seen.add(name)
                names |= self.names[name]
                open_ones += self.included[name]
        classes = {of_class for scopes in DEFINES_MEMBERS.findall(text) for of_class in scopes.split("::")}
        while classes:
            words, bases = self.classes.get(classes.pop(), (set(), set()))
            names |= words
            classes |= bases & self.classes.keys()
        return names


def renamed(text, of_headers):
    """Local names of a file that another can stand for in that file."""
    bare = without_comments(text)
    in_classes = set().union(*(words for words, _ in class_words(bare).values()))
    taken = of_headers | (set(QUALIFIED.findall(bare)) & in_classes)
    for line in PASTING.findall(bare):
        taken |= set(re.findall(r"\w+", line))
    return {name for name in local_names(text) - taken if not name.startswith("__")}


def with_names_of_its_own(text, names, place):
    """The text with other names for those given."""
    def other(match):
        return f"{match['name']}_of_{place}" if match["name"] in names else match[0]
    return PIECE.sub(other, text) if names else text


class Batch:
    """Files that can be read one behind the other."""

    def __init__(self):
        self.members, self.taken, self.used, self.closed = [], set(), set(), False

    def admits(self, names, words):
        return not self.closed and not names & self.used and not words & self.taken

    def add(self, source, names, words):
        self.members.append(source)
        self.taken |= names
        self.used |= words


def batches(sources, largest, kept=None, headers=None):
    """Of each batch its sources, in order. kept: of a source the number of the batch it was in.
    headers: of the project; without them no name is taken to be renamed."""
    kept = kept or {}
    made = [Batch() for _ in range(max(kept.values(), default=-1) + 1)]
    for source in sorted(sources, key=lambda source: source not in kept):
        text = pathlib.Path(source).read_text(encoding="utf-8")
        names, words = local_names(text), set(WORD.findall(without_comments(text)))
        if headers is not None:
            free = renamed(text, headers.declared(text))
            names, words = names - free, words - free
        alone = SETS_FOR_HEADERS.search(text) is not None
        first = made[kept[source]:kept[source] + 1] if source in kept else []
        for batch in [*first, *made]:
            if len(batch.members) < (1 if alone else largest) and batch.admits(names, words):
                break
        else:
            made.append(batch := Batch())
        batch.add(source, names, words)
        batch.closed = alone
    return [batch.members for batch in made]


def batch_text(members, headers):
    """The source of a batch: what all its files include, then their texts."""
    texts = [pathlib.Path(member).read_text(encoding="utf-8") for member in members]
    heads = [SETS_FOR_HEADERS.sub("", text) for text in texts]
    included = {name for head in heads for name in INCLUDE.findall(CONDITION.sub("", head))}
    lines = [f"#include {FIRST}"] if FIRST in included else []
    lines += [f"#include {name}" for name in sorted(included - {FIRST}, key=lambda name: (name[0] == '"', name))]
    for member, text in zip(members, texts):
        place = re.sub(r"\W", "_", "_".join(pathlib.Path(member).with_suffix("").parts[-2:]))
        lines.append(f'#line 1 "{member}"')
        lines.append(with_names_of_its_own(text, renamed(text, headers.declared(text)), place))
    return "\n".join(lines) + "\n"


def write_if_changed(path, text):
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def main():
    folder, largest, sources = pathlib.Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]
    memory, kept = folder / "kept.txt", {}
    if memory.exists():
        for line in memory.read_text(encoding="utf-8").splitlines():
            number, source = line.split(" ", 1)
            if source in sources:
                kept[source] = int(number)
    folder.mkdir(parents=True, exist_ok=True)
    headers = Headers(pathlib.Path(__file__).resolve().parent.parent)
    memories = []
    for number, members in enumerate(batches(sources, largest, kept, headers)):
        memories += [f"{number} {source}\n" for source in members]
        if members:
            path = folder / f"batch_{number}.cpp"
            write_if_changed(path, batch_text(members, headers))
            print(path)
    memory.write_text("".join(memories), encoding="utf-8")


if __name__ == "__main__":
    main()
