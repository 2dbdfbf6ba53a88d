"""Every command that the documentation shows is run: here, by another test, or, for a reason, by nobody.

A command is a line of a code block, or a code span, that begins with ./dev, boresight, cmake, mpirun or
.ci. One of `boresight` that names no stand-in is run as it stands, in a folder that has the project's cases;
one with stand-ins (CASE, FILE) must be what the command line takes. ELSEWHERE names the rest, and must
name nothing else.

usage: commands_test.py PROGRAM SOURCE_FOLDER
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import markdown

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
BEGIN = re.compile(r"(?:\./dev|boresight|\.ci/\w+|cmake|ctest|mpirun|export|source)(?: |$)")
CASE = "cases/dss14-70m/case.toml"

# Who runs it, or why nobody does in a test.
ELSEWHERE = {
    "./dev run": ".ci/fresh-machine",
    "./dev test": ".ci/run",
    "./dev lint": ".ci/run",
    ".ci/run": "runs this test among all others",
    "./dev help": "prints the script's own text",
    "./dev accuracy": "tests/accuracy compares its table",
    "./dev api": "tests/docs/api_test.py",
    "./dev bench": "minutes of timing",
    "./dev coverage": "an hour of two cores",
    "./dev faults": "an hour of two cores; tests/faults/faults_test.cpp runs a few",
    "./dev limit-cycles": "a quarter of an hour; tests/statistical/limit_cycle_prediction_test.cpp runs sixty loops",
    "./dev compare": "minutes, and a program of another build",
    "./dev figures": "draws docs/figures; their numbers are tested by identification_doc and readme",
    "./dev package": "tests/packaging",
    "./dev python": "tests/python imports the module and runs the document's examples",
    "./dev peers": "minutes, and programs that only it needs",
    "./dev schemas": "tests/app/report/report_schemas_test.cpp compares what it writes",
    "./dev screenshots": "draws two pictures; what they show is tested by tests/app/page_test.mjs",
    "./dev setup": "installs packages",
    "export PATH": "tests/docs/quickstart_test.py does so",
    "source <(boresight completion": "tests/app/program_test.py",
    "boresight man": "tests/app/program_test.py",
    "boresight new": "tests/docs/quickstart_test.py",
    "cmake --preset release -D BORESIGHT_MPI=ON": "tests/CMakeLists.txt builds boresight_mpi",
    "cmake -D BORESIGHT_PYTHON=ON": "tests/CMakeLists.txt tests the module that is built",
    "cmake --install": "tests/consumer",
    "mpirun": "tests/app/montecarlo_test.py",
    "boresight redesign cases/": "readme",
    "boresight tune cases/": "readme",
    "boresight identify cases/": "readme",
    "boresight simulate cases/": "readme",
    "boresight match cases/": "minutes; match_test and json_schema run smaller ones",
    "boresight evaluate cases/": "evaluate_doc",
    "boresight montecarlo cases/": "montecarlo",
    "boresight commission cases/": "commission_schema",
    "boresight audit my-antenna": "tests/docs/quickstart_test.py",
    "boresight model my-antenna": "tests/docs/quickstart_test.py",
    "boresight redesign my-antenna": "tests/docs/quickstart_test.py",
    "boresight tune my-antenna": "tests/docs/quickstart_test.py",
}


def commands():
    """{command: where it stands first}, comments and continuation of prose cut off."""
    found = {}
    for document in markdown.documents(SOURCE):
        prose, code = markdown.split(document)
        name = document.relative_to(SOURCE)
        spans = [(number, span) for number, line in prose for span in markdown.INLINE.findall(line)]
        for number, line in code + spans:
            line = re.sub(r"\s+#.*", "", line).strip()
            line = re.sub(r"^\./dev run (?=[a-z])", "boresight ", line)
            # A word alone or a synopsis is no call.
            if BEGIN.match(line) and (" " in line or line.startswith(".ci")) and "[" not in line and "..." not in line:
                found.setdefault(line, f"{name}:{number}")
    return found


def refusal(line):
    """Why the program does not run the command, or does not take its words; empty if it does."""
    words = shlex.split(line)[1:]
    if len(words) == 1:  # the command's name
        words.append("--help")
    stand_in = any(re.fullmatch(r"[A-Z][A-Z_.]*(?:=[A-Z]+)?|\w+=VALUE", word) for word in words)
    with tempfile.TemporaryDirectory() as folder:
        for name in ("cases", "docs", "tests"):
            pathlib.Path(folder, name).symlink_to(SOURCE / name)
        result = subprocess.run([str(PROGRAM), *words], cwd=folder, capture_output=True, text=True,
                                check=False, timeout=600)
    if result.returncode == 0 or (stand_in and "--help" not in result.stderr
                                  and "misspelt" not in result.stderr):
        return ""
    return result.stderr or f"exit code {result.returncode}"


def main():
    used, faults, run = set(), [], 0
    found = commands()
    assert len(found) > 30, "the documentation shows less than it did"
    for line, place in found.items():
        reasons = [begin for begin in ELSEWHERE if line.startswith(begin)]
        used.update(reasons)
        if reasons:
            continue
        # A command's name in prose, with the option that the sentence is about.
        if not line.startswith("boresight ") or (
                re.match(r"boresight \w+ --?\w", line) and "--help" not in line):
            if not line.startswith("boresight "):
                faults.append(f"{place}: nobody runs `{line}`")
            continue
        run += 1
        why = refusal(line)
        if why:
            faults.append(f"{place}: `{line}`: {why.strip()}")
    faults += [f"listed, and not in the documentation: {begin}" for begin in ELSEWHERE
               if begin not in used]
    print("\n".join(faults) or f"{len(found)} commands, {run} of them run here")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
