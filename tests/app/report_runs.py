"""The reports of the program that its tests look at, each computed once.

Imported by what reports_test.py runs.
"""

import functools
import json
import pathlib
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])

BIG, SMALL = "dss14-70m", "dss14-64m"
# A campaign's case with a few of its records.
RECORDED, RECORDS = "recorded", ("slosh", "fast_ramp", "constant_speed_0.14deg_s", "valve_steps")
CHEAP = ("audit", "identify", "model")
SECTIONS = {"audit": "audit", "identify": "identification", "model": "plant"}
# A matching study small enough for a test.
SMALL_MATCH = ("--structure", "PI", "--structure", "PI-0", "--points", "4", "--starts", "2")
# Cheap to evaluate: what is checked is the report, not the search.
PROPOSALS = [*(f"cases/{BIG}/proposals/{name}.toml" for name in
               ("half-flywheels", "pressure-feedback")), "--structure", "PI", "--draws", "100", "--starts", "2"]
# The 70-m case with the tables that only tuning reads: its own loop, present gains, wind climate.
TUNED = "tuned"


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON")


def recorded_case():
    campaign = pathlib.Path(PROGRAM).parent.parent / "campaigns/small-dish"
    common, *entries = (campaign / "case.toml").read_text(encoding="utf-8").split("[[record]]")
    wanted = [entry.replace('file = "', f'file = "{campaign}/') for entry in entries
              if any(f'"{name}.csv"' in entry for name in RECORDS)]
    return "[[record]]".join((common, *wanted))


def tuned_case():
    return "\n".join((SOURCE / name).read_text(encoding="utf-8") for name in
                     (f"cases/{BIG}/case.toml", "tests/data/tuning/tables.toml"))


def run(command, case, threads=2, seed=1):
    """Bytes of the JSON report, and the whole text."""
    return run_once(command, case, threads, seed)


# Of all four arguments, as given: what is left out would count as another call.
@functools.lru_cache(maxsize=None)
def run_once(command, case, threads, seed):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.json"
        case_path = f"cases/{case}/case.toml"
        if case in (RECORDED, TUNED):
            case_path = pathlib.Path(folder) / "case.toml"
            case_path.write_text(recorded_case() if case == RECORDED else tuned_case(),
                                 encoding="utf-8")
        process = subprocess.run(
            [PROGRAM, command, str(case_path), *(PROPOSALS if command == "evaluate" else ()),
             "--details", "--json", str(path), "--threads",
             str(threads), "--seed", str(seed), *(SMALL_MATCH if command == "match" else ())],
            cwd=SOURCE, capture_output=True, text=True, check=True)
        assert process.stderr == "", process.stderr
        return path.read_bytes(), process.stdout


def report(command, case=BIG, threads=2, seed=1):
    return json.loads(run(command, case, threads, seed)[0], parse_constant=refuse_constant)


def every_report():
    for command in (*CHEAP, "redesign"):
        yield command, BIG, report(command)
    yield "tune", TUNED, report("tune", TUNED)
    yield "evaluate", BIG, report("evaluate")
    yield "match", BIG, report("match", threads=1)
    for command in CHEAP:
        yield command, SMALL, report(command, SMALL)
    yield "identify", RECORDED, report("identify", RECORDED)
