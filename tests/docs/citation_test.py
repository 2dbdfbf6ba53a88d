"""CITATION.cff has what the format's version 1.2.0 requires, and the version of the project.

usage: citation_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys

import yaml

# Of the format's schema: what must be there, and what may (https://citation-file-format.github.io).
REQUIRED = {"authors", "cff-version", "message", "title"}
ALLOWED = REQUIRED | {"abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords",
                      "license", "license-url", "preferred-citation", "references", "repository",
                      "repository-artifact", "repository-code", "type", "url", "version"}
PERSON = {"address", "affiliation", "alias", "city", "country", "email", "family-names", "fax",
          "given-names", "name-particle", "name-suffix", "orcid", "post-code", "region", "tel", "website"}
ENTITY = {"address", "alias", "city", "country", "date-end", "date-start", "email", "fax", "location",
          "name", "orcid", "post-code", "region", "tel", "website"}


def check_authors(authors):
    assert authors, "nobody wrote it"
    for author in authors:
        assert set(author) <= ENTITY if "name" in author else set(author) <= PERSON, author


def main(root):
    citation = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    assert REQUIRED <= set(citation) <= ALLOWED, set(citation) ^ REQUIRED
    assert citation["cff-version"] == "1.2.0" and citation["type"] in ("software", "dataset")
    check_authors(citation["authors"])
    for work in citation.get("references", []):
        assert {"authors", "title", "type"} <= set(work), work
        check_authors(work["authors"])
    words = citation["keywords"]
    assert words and len(words) == len(set(words)) and all(isinstance(word, str) for word in words)
    version = re.search(r"project\(Boresight VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
    assert str(citation["version"]) == version, f"the project is {version}"
    licence = (root / "LICENSE").read_text()
    assert citation["license"] == "BSD-3-Clause" and "Neither the name" in licence
    assert f"## {version}\n" in (root / "CHANGELOG.md").read_text(), "CHANGELOG.md lacks the version"
    print("a valid citation")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
