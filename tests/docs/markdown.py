"""Reads what the tests of the documentation need of a Markdown file."""

import pathlib
import re
import subprocess

FENCE = re.compile(r"^(```|~~~)")
INLINE = re.compile(r"`([^`\n]+)`")


def documents(root):
    """Every Markdown file that the version control knows, from the root of the project."""
    names = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--", "*.md"],
                           capture_output=True, text=True, check=True).stdout.split("\0")
    return [pathlib.Path(root) / name for name in sorted(filter(None, names))
            if (pathlib.Path(root) / name).is_file()]


def split(path):
    """(prose, code): [(line number, line)] of each. Code is what stands between fences, or indented
    by four blanks after an empty line outside of a list."""
    prose, code, fenced, in_list, indented, before = [], [], False, False, False, ""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if FENCE.match(line.strip()):
            fenced = not fenced
        elif fenced:
            code.append((number, line.strip()))
        elif line.startswith("    ") and (indented or (not before.strip() and not in_list)):
            indented = True
            code.append((number, line[4:]))
        else:
            indented = indented and not line.strip()
            if line.strip():
                in_list = bool(re.match(r" *([-*]|\d+\.) ", line)) or (in_list and line[:1] == " ")
            prose.append((number, line))
        before = line
    return prose, code


def anchors(path):
    """What a link may name behind '#': headings as the usual viewers make ids of them."""
    found, prose = set(), split(path)[0]
    for _, line in prose:
        heading = re.match(r"#+ (.*)", line)
        if not heading:
            continue
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1)).replace("`", "").lower()
        name = re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-")
        count = 0
        while f"{name}-{count}" * (count > 0) + name * (count == 0) in found:
            count += 1
        found.add(name if count == 0 else f"{name}-{count}")
    for _, line in prose:
        found.update(re.findall(r'(?:id|name)="([^"]+)"', line))
    return found
