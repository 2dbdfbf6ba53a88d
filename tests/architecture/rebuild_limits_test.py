"""A new field of a case's section, or of the evaluator's state, is compiled again by few sources only.

Counts the sources that reach, by any chain of includes, the header that defines a section of the case
(CASE_LIMIT) or the private state of the loop evaluator (STATE_LIMIT). The case itself holds its sections
by pointer or in vectors, beside the plain members listed here.

usage: rebuild_limits_test.py SOURCE_FOLDER
"""

import pathlib
import posixpath
import re
import subprocess
import sys
import tempfile

CASE_LIMIT, STATE_LIMIT = 60, 15
CASE, EVALUATOR = "io/case/case_file.hpp", "control/loops/loop_evaluator.hpp"
STATE = "control/loops/loop_evaluator_state.hpp"
PLAIN_MEMBERS = {"path", "title", "axis"}
NO_SECTION = {"Quantity"}  # a number with its source, of every module that reads files
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
MEMBER = re.compile(r"^  (?:(?:Section|OptionalSection|std::vector)<(\w+)>|[\w:<>]+) ([\w, ]+)(?: = [^;]+)?;", re.M)


def listed(root):
    """C++ files that the version control knows, else all."""
    names = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True,
                           check=False).stdout.split("\0")
    if names == [""]:
        names = [path.relative_to(root).as_posix() for path in root.rglob("*")]
    return [name for name in names if name.endswith((".cpp", ".hpp")) and (root / name).is_file()]


def includers(root):
    """Of each file those that include it."""
    names, found = set(listed(root)), {}
    for name in names:
        for target in INCLUDE.findall((root / name).read_text(encoding="utf-8")):
            places = (target.removeprefix("boresight/"), posixpath.join(posixpath.dirname(name), target),
                      "tests/" + target)
            place = next((place for place in map(posixpath.normpath, places) if place in names), None)
            if place:
                found.setdefault(place, set()).add(name)
    return found


def rebuilt(header, graph):
    """Sources that include a header, directly or through others."""
    seen, ahead = set(), [header]
    while ahead:
        new = graph.get(ahead.pop(), set()) - seen
        seen |= new
        ahead += new
    return sorted(name for name in seen if name.endswith(".cpp"))


def sections(root):
    """[(type, its header or nothing)] of the case, and members that are no sections."""
    body = re.search(r"^struct Case \{(.*?)^\};", (root / CASE).read_text(encoding="utf-8"), re.M | re.S)[1]
    headers = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
               for path in (root / "io").rglob("*.hpp")}
    types, plain = [], set()
    for kind, names in MEMBER.findall(body):
        if not kind:
            plain |= set(names.split(", "))
        elif kind not in NO_SECTION:
            types.append((kind, next((name for name, text in headers.items()
                                      if re.search(rf"^struct {kind} \{{", text, re.M)), None)))
    return types, plain


def complaints(root):
    graph, found = includers(root), []
    types, plain = sections(root)
    found += [f"{CASE}: {name} is no section" for name in sorted(plain - PLAIN_MEMBERS)]
    if not types:
        found.append(f"{CASE}: no section found")
    limited = {header: CASE_LIMIT for _, header in types if header} | {STATE: STATE_LIMIT}
    found += [f"{CASE}: no header defines {kind}" for kind, header in types if not header]
    for header, limit in sorted(limited.items()):
        count = len(rebuilt(header, graph))
        if not 0 < count <= limit:
            found.append(f"{header}: {count} sources include it, at most {limit} and at least 1 may")
    private = re.search(r"^class LoopEvaluator \{.*?^ private:\n(.*?)^\};",
                        (root / EVALUATOR).read_text(encoding="utf-8"), re.M | re.S)[1]
    members = re.findall(r"[\w:<>]+ (\w+_)\b", re.sub(r"//.*", "", private))
    if members != ["state_"]:
        found.append(f"{EVALUATOR}: private members {members}, expected state_ only")
    return found


def check_itself():
    """Each excess must be seen, and what is allowed must not."""
    def planted(readers, states, members="  Section<WindEntry> wind;\n", private="  std::unique_ptr<State> state_;\n"):
        files = {CASE: "struct Case {\n  std::string path;\n" + members + "  std::vector<Quantity> numbers;\n};\n",
                 "io/case/wind.hpp": "struct WindEntry {\n};\n",
                 "tests/near.hpp": "#include <boresight/io/case/wind.hpp>\n",
                 EVALUATOR: "class LoopEvaluator {\n private:\n" + private + "};\n", STATE: ""}
        # By two headers of the tests, and beside one another.
        files["tests/io/far.hpp"] = '#include "near.hpp"\n'
        files |= {f"tests/io/a{i}.cpp": '#include "far.hpp"\n' for i in range(readers)}
        files |= {f"control/b{i}.cpp": f"#include <boresight/{STATE}>\n" for i in range(states)}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return complaints(pathlib.Path(folder))

    assert planted(CASE_LIMIT, STATE_LIMIT) == []
    for excess in (planted(CASE_LIMIT + 1, STATE_LIMIT), planted(CASE_LIMIT, STATE_LIMIT + 1),
                   planted(1, 1, "  Section<WindEntry> wind;\n  double mast = 0.0;\n"),
                   planted(1, 1, "  Section<WindEntry> wind;\n  std::vector<LostEntry> lost;\n"),
                   planted(1, 1, private="  std::unique_ptr<State> state_;\n  int calls_;\n")):
        assert len(excess) == 1, excess


if __name__ == "__main__":
    check_itself()
    offences = complaints(pathlib.Path(sys.argv[1]))
    print("\n".join(offences))
    sys.exit(1 if offences else 0)
