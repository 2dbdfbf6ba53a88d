#!/usr/bin/env python3
"""Every public header reaches, by its own includes or those of the project's headers that it names, what
it uses of the standard library, of Eigen and of the project's types, and can be included twice. (The
debug preset compiles each alone as well, which sees functions, constants and types that are only declared.)

  header_includes_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys

MODULES = ("numerics", "plant", "identification", "control", "design", "io")
# Of names of std the header that declares them.
DECLARED_IN = {
    "any": "any", "array": "array", "atomic": "atomic", "complex": "complex", "deque": "deque",
    "exception": "exception", "function": "functional", "initializer_list": "initializer_list",
    "int64_t": "cstdint", "map": "map", "mt19937_64": "random", "mutex": "mutex", "numbers": "numbers",
    "numeric_limits": "limits", "optional": "optional", "ostream": "iosfwd", "runtime_error": "stdexcept",
    "set": "set", "shared_ptr": "memory", "span": "span", "string": "string",
    "string_view": "string_view", "thread": "thread", "tuple": "tuple", "uint64_t": "cstdint",
    "unique_ptr": "memory", "unordered_map": "unordered_map", "variant": "variant", "vector": "vector",
}
# What headers are bound by the standard, or by their own interface, to bring along.
BROUGHT = {
    "Eigen/Core": {"complex", "limits", "functional"},
    "string": {"string_view", "initializer_list"},
    "filesystem": {"string"},
}
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.M)
# Types that a header defines or declares, at namespace level, then nested ones.
OUTER = re.compile(r"^(?:struct|class|enum class|enum|union) (?:\[\[\w+\]\] )?(\w+)|^using (\w+) =", re.M)
INNER = re.compile(r"^ +(?:struct|class|enum class|using) (\w+)", re.M)


def code(header):
    text = re.sub(r"//.*|/\*(?:.|\n)*?\*/", "", header.read_text(encoding="utf-8"))
    return re.sub(r'"(?:\\.|[^"\\\n])*"(?!>)', '""', text)


def types_at_the_margin(text):
    return {one or other for one, other in OUTER.findall(text)}


def reached(header, root, seen):
    """Names of the headers outside the project that a header includes, itself or by the project's; these
    are added to `seen`."""
    names = set()
    for name in INCLUDE.findall(header.read_text(encoding="utf-8")):
        own = root / name.removeprefix("boresight/")
        if name.startswith("boresight/") and own.is_file():
            if own not in seen:
                seen.add(own)
                names |= reached(own, root, seen)
        else:
            names.add(name)
    if any(name.startswith("Eigen/") for name in names):
        names |= BROUGHT["Eigen/Core"]
    for name in list(names):
        names |= BROUGHT.get(name, set())
    return names


def lacking(header, root, codes, types):
    text = codes[header]
    needed = {DECLARED_IN[name] for name in re.findall(r"std::(\w+)", text) if name in DECLARED_IN}
    seen = {header}
    names = reached(header, root, seen)
    found = sorted(needed - names)
    used = set(re.findall(r"\b[A-Z]\w+\b", text)) & set().union(*types.values())
    found += sorted(used - set(INNER.findall(text)) - set().union(*(types[one] for one in seen)))
    if not re.search(r"^#pragma once$", text, re.M):
        found.append("#pragma once")
    if "Eigen::" in text and not any(name.startswith("Eigen/") for name in names):
        found.append("Eigen")
    return found


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    headers = [header for module in MODULES for header in sorted((root / module).rglob("*.hpp"))]
    codes = {header: code(header) for header in headers}
    types = {header: types_at_the_margin(text) for header, text in codes.items()}
    complaints = [f"{header.relative_to(root)} lacks {', '.join(found)}"
                  for header in headers if (found := lacking(header, root, codes, types))]
    if sum(map(len, types.values())) < 500:
        complaints.append("the project's types were not found where they stand")
    print("\n".join(complaints))
    return 1 if complaints or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
