"""Modules and their folders include one way only.

A module includes itself and what stands before it in BEFORE; no two folders include one another,
directly or through others. Formats of files (TOML, JSON) are the business of io and what follows it,
the command line that of app, Python that of python; an example uses installed libraries only.

usage: module_order_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys
import tempfile

# Of each module what it may include beside itself. Identification and control do not know one another.
BEFORE = {"numerics": [], "plant": ["numerics"]}
BEFORE["identification"] = BEFORE["control"] = ["numerics", "plant"]
BEFORE["design"] = ["numerics", "plant", "identification", "control"]
BEFORE["io"] = [*BEFORE["design"], "design"]
BEFORE["app"] = [*BEFORE["io"], "io"]
BEFORE["python"] = BEFORE["app"] + ["app"]
BEFORE["examples"] = BEFORE["app"]
# Who may know the libraries of others whose headers begin so.
KNOWN_BY = {"toml++/": {"io"}, "nlohmann/": {"io", "app", "python"}, "CLI/": {"app"},
            "pybind11/": {"python"}}
# Folders of a module that are still one knot.
KNOTS = {"app"}
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(root):
    """[(file, bracket, what it includes)] of the sources of all modules."""
    for module in BEFORE:
        for path in sorted((root / module).rglob("*.[ch]pp")):
            for line in path.read_text(encoding="utf-8").splitlines():
                if match := INCLUDE.match(line):
                    yield path.relative_to(root), *match.groups()


def cycle_in(edges):
    """Folders that include one another in a ring, the first one found, or nothing."""
    state, way = {}, []

    def visit(folder):
        state[folder] = "open"
        way.append(folder)
        for other in sorted(edges.get(folder, ())):
            if state.get(other) == "open":
                return [*way[way.index(other):], other]
            if other not in state and (ring := visit(other)):
                return ring
        state[folder] = "done"
        way.pop()
        return None

    for folder in sorted(edges):
        if folder not in state and (ring := visit(folder)):
            return ring
    return None


def offences(root):
    found, edges = [], {}
    for file, bracket, target in includes(root):
        module, folder = file.parts[0], file.parent.as_posix()
        if bracket == '"':
            # It finds a neighbour in the tree, but not once installed.
            if module != "examples":
                found.append(f"{file}: includes \"{target}\" by quotes")
            continue
        for prefix, modules in KNOWN_BY.items():
            if target.startswith(prefix) and module not in modules:
                found.append(f"{file}: knows {prefix}")
        if not target.startswith("boresight/") or target.count("/") < 2:
            continue
        path = pathlib.PurePosixPath(target).relative_to("boresight")
        if path.parts[0] != module and path.parts[0] not in BEFORE[module]:
            found.append(f"{file}: includes {target} against the order of the modules")
        elif path.parent.as_posix() != folder and not {module, path.parts[0]} & KNOTS:
            edges.setdefault(folder, set()).add(path.parent.as_posix())
    if ring := cycle_in(edges):
        found.append(f"folders include one another: {' -> '.join(ring)}")
    return found


def check_itself():
    """Each kind of offence must be seen, and what is allowed must not."""
    allowed = {"plant/linear/a.hpp": "#include <boresight/numerics/b.hpp>\n#include <vector>\n",
               "io/case/c.cpp": "#include <toml++/toml.h>\n#include <boresight/plant/linear/a.hpp>\n",
               "examples/d.cpp": '#include "near.hpp"\n#include <boresight/io/case/c.hpp>\n'}
    forbidden = [
        {"plant/linear/up.hpp": "#include <boresight/control/loops/a.hpp>\n"},
        {"control/loops/aside.cpp": "#include <boresight/identification/records/a.hpp>\n"},
        {"design/tuning/reads.cpp": "#include <toml++/toml.h>\n"},
        {"io/case/prints.cpp": "#include <CLI/CLI.hpp>\n"},
        {"app/page/knows.cpp": "#include <pybind11/pybind11.h>\n"},
        {"examples/program.cpp": "#include <boresight/app/page/page.hpp>\n"},
        {"plant/linear/quotes.cpp": '#include "near.hpp"\n'},
        {"plant/a/a.hpp": "#include <boresight/plant/b/b.hpp>\n",
         "plant/b/b.hpp": "#include <boresight/plant/c/c.hpp>\n",
         "plant/c/c.hpp": "#include <boresight/plant/a/a.hpp>\n"}]
    for files, expected in [(allowed, 0)] + [({**allowed, **files}, 1) for files in forbidden]:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            assert len(offences(pathlib.Path(folder))) == expected, (files, offences(pathlib.Path(folder)))


if __name__ == "__main__":
    check_itself()
    faults = offences(pathlib.Path(sys.argv[1]))
    print("\n".join(faults) or "modules and folders include one way only")
    sys.exit(1 if faults else 0)
