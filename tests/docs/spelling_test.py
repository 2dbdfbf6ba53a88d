"""The documentation and the program's manual are spelt as an English dictionary or
tests/docs/words.txt has it; the sources have none of the usual misspellings.

usage: spelling_test.py PROGRAM SOURCE_FOLDER [--list]     --list prints the unknown words alone
"""

import pathlib
import re
import subprocess
import sys

import markdown

# What is no prose: code, addresses, tags, numbers with units, names with digits or underlines.
NO_PROSE = (re.compile(r"`[^`]*`"), re.compile(r"\]\([^)]*\)"), re.compile(r"<[^>]+>"),
            re.compile(r"https?://\S+"), re.compile(r"\S*[\d_/\\=^{}@]\S*"),
            re.compile(r"\b[A-Za-z]{1,2}\b"), re.compile(r"[^\w\s'-]|--+"))


def prose_of(path):
    """[(line number, text)] without what is no prose; code spans may run over a line's end."""
    lines = markdown.split(path)[0]
    text = "\n".join(line for _, line in lines)
    text = re.sub(r"<!--.*?-->", lambda hit: re.sub(r"[^\n]", " ", hit.group()), text, flags=re.S)
    text = re.sub(r"`[^`]*?`", lambda hit: re.sub(r"[^\n]", " ", hit.group()), text)
    for pattern in NO_PROSE:
        text = "\n".join(pattern.sub(" ", line) for line in text.split("\n"))
    return [(number, line) for (number, _), line in zip(lines, text.split("\n"))]


def unknown_words(text, words):
    """The words that neither dictionary nor list knows."""
    spelt = subprocess.run(["hunspell", "-l", "-d", "en_GB,en_US", "-i", "utf-8"], input=text,
                           capture_output=True, text=True, check=True)
    return {word for word in spelt.stdout.split()
            if word not in words and word.strip("'-").removesuffix("'s") not in words
            and not (word[0].isupper() and word.lower() in words)}


def manual_of(program):
    """The manual's sentences, without troff."""
    page = subprocess.run([program, "man"], capture_output=True, text=True, check=True).stdout
    lines = [line for line in page.splitlines() if not line.startswith((".", "\\fB", "\\fI"))]
    text = re.sub(r"\\f[BI].*?\\fR", " ", "\n".join(lines)).replace("\\(aq", "'").replace("\\-", "-")
    for pattern in NO_PROSE:
        text = pattern.sub(" ", text)
    return text


def main(program, root, only_list):
    words = {line.strip() for line in (root / "tests/docs/words.txt").read_text(encoding="utf-8")
             .splitlines() if line.strip() and not line.startswith("#")}
    places, texts = {}, {}
    for document in markdown.documents(root):
        texts[str(document.relative_to(root))] = prose_of(document)
    texts["boresight man"] = list(enumerate(manual_of(program).splitlines(), 1))
    unknown = unknown_words("\n".join(line for lines in texts.values() for _, line in lines), words)
    for name, lines in texts.items():
        for number, line in lines:
            for word in set(re.findall(r"[\w'-]+", line)) & unknown:
                places.setdefault(word, f"{name}:{number}")
    if only_list:
        print("\n".join(sorted(unknown)))
        return 0
    for word in sorted(unknown):
        print(f"{places.get(word, '?')}: {word}")
    tracked = subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, text=True,
                             check=True).stdout.split("\n")
    written = [name for name in tracked
               if pathlib.PurePath(name).suffix in (".cpp", ".hpp", ".py", ".md", ".cmake", ".txt",
                                                    ".toml", ".json", "")
               and not name.startswith(("tests/", "LICENSE"))  # tests misspell on purpose
               and "lock" not in name and name and (root / name).is_file()]
    usual = subprocess.run(["codespell", "--ignore-words", "tests/docs/words.txt", *written],
                           cwd=root, capture_output=True, text=True, check=False)
    print(usual.stdout, end="")
    if not unknown and not usual.stdout:
        print(f"{len(texts)} texts and {len(written)} files are spelt right")
    return 1 if unknown or usual.stdout else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), "--list" in sys.argv))
