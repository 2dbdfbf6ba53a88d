#!/usr/bin/env python3
"""Every public header reaches, by its own includes or those of the project's headers that it names, what
it uses of the standard library and of Eigen. (That it compiles alone is seen by the target
header_self_sufficiency, whose precompiled header would hide these two.)

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


def reached(header, root, seen):
    """Names of the headers outside the project that a header includes, itself or by the project's."""
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


def lacking(header, root):
    text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
    needed = {DECLARED_IN[name] for name in re.findall(r"std::(\w+)", text) if name in DECLARED_IN}
    names = reached(header, root, {header})
    found = sorted(needed - names)
    if "Eigen::" in text and not any(name.startswith("Eigen/") for name in names):
        found.append("Eigen")
    return found


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    headers = [header for module in MODULES for header in sorted((root / module).rglob("*.hpp"))]
    complaints = [f"{header.relative_to(root)} lacks {', '.join(found)}"
                  for header in headers if (found := lacking(header, root))]
    print("\n".join(complaints))
    return 1 if complaints or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
