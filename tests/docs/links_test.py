"""Every link of the documentation leads somewhere, and every path that it names is there.

Links to files and headings are followed in the tree; links to the web are looked at for their form
only, since a test needs no network.

usage: links_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys
import urllib.parse

import markdown

LINK = re.compile(r"(?<!\!)\[[^\]]*\]\(([^)\s]+)[^)]*\)|!\[[^\]]*\]\(([^)\s]+)\)|(?:href|src)=\"([^\"]+)\"")
# A file of the project as prose names it.
PATH = re.compile(r"`((?:app|bench|cases|cmake|control|design|docs|identification|plant|python|tests|web|"
                  r"examples)/[\w./-]+\.\w+)`")
# Named in prose, and made by a build or by the reader.
MADE = re.compile(r"^(web/node_modules|cases/[\w-]*my-)")


def faults(root):
    found = []
    for document in markdown.documents(root):
        name = document.relative_to(root)
        for number, line in markdown.split(document)[0]:
            for link in filter(None, (part for match in LINK.findall(re.sub(markdown.INLINE, "", line))
                                      for part in match)):
                target = urllib.parse.urlsplit(link)
                if target.scheme:
                    if target.scheme not in ("https", "http", "mailto") or (
                            target.scheme != "mailto" and "." not in target.netloc):
                        found.append(f"{name}:{number}: {link} is no address")
                    continue
                path = (document.parent / urllib.parse.unquote(target.path)).resolve() \
                    if target.path else document
                if not path.exists():
                    found.append(f"{name}:{number}: {link}: no such file")
                elif target.fragment and path.suffix == ".md" and \
                        target.fragment not in markdown.anchors(path):
                    found.append(f"{name}:{number}: {link}: no such heading")
            for path in PATH.findall(line):
                beside = [root / path, document.parent / path]
                if not MADE.match(path) and not any(one.exists() for one in beside):
                    found.append(f"{name}:{number}: {path} is named and not there")
    return found


if __name__ == "__main__":
    problems = faults(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(problems) or "every link leads somewhere")
    sys.exit(1 if problems else 0)
