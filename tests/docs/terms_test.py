"""Documents and the comments of public headers use the field's terms and not the private ones that stood
for them.

usage: terms_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys

import markdown

MODULES = ("numerics", "plant", "identification", "control", "design", "io", "app")

# (private term, what to write). Legitimate senses are left out by the pattern.
TERMS = (
    (r"(?<!power )laws?\b", "controller; structure and gains; model"),
    (r"held (?:on|gains?)\b", "evaluated with fixed gains"),
    (r"(?:may be|might be) the true one", "ensemble member, uncertainty set"),
    (r"hard goals?\b", "constraint"),
    (r"soft goals?\b", "objective"),
    (r"hunt(?:s|ed|ing)?\b", "limit cycle"),
    (r"(?:holds?|held) still\b", "is free of limit cycles"),
    (r"more buys\b", "relaxing this limit lowers the rms by"),
    (r"turn(?:s|ed|ing)? round\b", "velocity reversal"),
    (r"beam (?:error|rms)\b", "boresight error"),
    (r"heavy\b|heavier\b", "of high inertia"),
    (r"hangs? (?:on|upon)\b", "depends on"),
    (r"goes with\b", "scales with"),
    (r"foretold\b|foretells?\b", "predicted"),
    (r"reckon\w*", "compute"),
    (r"in (?:the|its) (?:place|stead) of\b", "instead of"),
    (r"losses out\b", "damping-corrected"),
    (r"kept out of\b", "exclusion"),
)
PATTERNS = [(re.compile(r"\b(?:" + term + ")", re.I), instead) for term, instead in TERMS]
QUOTED = re.compile(r"`[^`]*`|\"[^\"]*\"")
COMMENT = re.compile(r"//.*")

# What a page quotes of a command whose words are still the old ones.
ALLOWED = {
    "docs/identification.md": {"losses out"},
    "docs/reference-designs.md": {"beam rms", "held on"},
}


def found_in(text):
    """[(term as it stands, what to write)] of a line, quotations and code aside."""
    prose = QUOTED.sub(" ", text)
    return [(hit.group(), instead) for pattern, instead in PATTERNS for hit in pattern.finditer(prose)]


def lines_of(root):
    """(file, line number, text) of all prose of documents and all comments of public headers."""
    for document in markdown.documents(root):
        name = str(document.relative_to(root))
        if name.startswith("docs/") or name == "README.md":
            for number, line in markdown.split(document)[0]:
                yield name, number, line
    for module in MODULES:
        for header in sorted((root / module).rglob("*.hpp")):
            for number, line in enumerate(header.read_text(encoding="utf-8").splitlines(), 1):
                if comment := COMMENT.search(line):
                    yield str(header.relative_to(root)), number, comment.group()


def main(root):
    # The patterns find what they are for, and leave a legitimate sense alone.
    assert found_in("the law that holds still on plants that may be the true one")
    assert not found_in("the power law of mean speed, `law` and \"hard goal\"")
    wrong, lines = [], 0
    for name, number, line in lines_of(root):
        lines += 1
        wrong += [f"{name}:{number}: '{term}': write '{instead}'" for term, instead in found_in(line)
                  if term.lower() not in ALLOWED.get(name, ())]
    assert lines > 5000, f"only {lines} lines were read"
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{lines} lines without a private term")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
