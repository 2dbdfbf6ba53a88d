"""Runs every command by two builds of the program and lists every answer that differs.

A change that moves code must not move numbers: JSON is compared value by value, the text as it stands.
Differences that are meant belong into the change's description, each with its reason.

usage: compare_programs.py OLD_PROGRAM NEW_PROGRAM SOURCE_FOLDER [--commands NAME ...] [--tolerance T]
       [--numbers]
Exit code 1 where something differs.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

CASES = {"70 m": "cases/dss14-70m/case.toml", "64 m": "cases/dss14-64m/case.toml",
         "campaign": "build/release/campaigns/full/case.toml"}
PROPOSALS = ["cases/dss14-70m/proposals/half-flywheels.toml", "cases/dss14-70m/proposals/no-flywheels.toml"]
COMMANDS = {
    "audit": [], "model": [], "identify": [], "redesign": [], "benchmark": [], "commission": [],
    "tune": [], "simulate": ["slow-ramp", "tracking", "--folder", "records"],
    "match": ["--points", "5", "--structure", "PI", "DPF", "--no-variants"],
    "evaluate": ["--structure", "PI", "--draws", "200", *PROPOSALS], "montecarlo": ["--plants", "500", "--structure", "PI"],
}


def answer(program, command, case, options, folder):
    """(exit code, text, JSON or None) of one command, run in the folder."""
    report = folder / "report.json"
    (folder / "records").mkdir(exist_ok=True)
    ended = subprocess.run([program, command, case, *options, "--seed", "1", "--json", str(report)]
                           if command not in ("audit", "model") else
                           [program, command, case, *options, "--json", str(report)],
                           cwd=folder, capture_output=True, text=True, check=False)
    return (ended.returncode, ended.stdout + ended.stderr,
            json.loads(report.read_text(encoding="utf-8")) if report.exists() else None)


def differences(old, new, tolerance, path=""):
    """[(path, old, new)] of every value that differs, numbers by more than the relative tolerance."""
    if isinstance(old, dict) and isinstance(new, dict):
        return [one for key in [*old, *(key for key in new if key not in old)]
                for one in differences(old.get(key), new.get(key), tolerance, f"{path}.{key}")]
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        return [one for i, (a, b) in enumerate(zip(old, new))
                for one in differences(a, b, tolerance, f"{path}[{i}]")]
    numbers = is_number(old) and is_number(new)
    same = math.isclose(old, new, rel_tol=tolerance, abs_tol=0.0) if numbers else old == new
    return [] if same else [(path, old, new)]


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def with_present_keys(value, names, inside=""):
    """The value with keys of an earlier version replaced: names as "renamed_keys" of a report lists them."""
    if isinstance(value, dict):
        return {names.get(f"{inside}.{key}", f".{names.get(key, key)}").rsplit(".", 1)[1]:
                with_present_keys(one, names, key) for key, one in value.items()}
    return [with_present_keys(one, names, inside) for one in value] if isinstance(value, list) else value


def check_itself():
    old = {"m": {"law": "x", "controller": [{"laws": 1}]}, "law": 2}
    assert with_present_keys(old, {"law": "controller", "m.law": "m.name", "laws": "all"}) == {
        "m": {"name": "x", "controller": [{"all": 1}]}, "controller": 2}
    base = {"a": [1.0, {"b": "x"}], "c": None}
    assert differences(base, json.loads(json.dumps(base)), 0.0) == []
    assert differences(base, {"a": [1.0 + 1e-9, {"b": "y"}]}, 0.0) == [
        (".a[0]", 1.0, 1.0 + 1e-9), (".a[1].b", "x", "y")]
    assert differences(base, {"a": [1.0, {"b": "x"}], "d": 2}, 0.0) == [(".d", None, 2)]
    assert differences(base, {"a": [1.0]}, 0.0)[0][0] == ".a"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs=2)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--commands", nargs="+", choices=COMMANDS, default=list(COMMANDS))
    parser.add_argument("--tolerance", type=float, default=0.0)
    parser.add_argument("--numbers", action="store_true",
                        help="list only numbers that both programs give, and not those that came or went")
    arguments = parser.parse_args()
    source, unequal = arguments.source.resolve(), 0
    programs = [str(pathlib.Path(program).resolve()) for program in arguments.programs]
    for command in arguments.commands:
        options = [str(source / option) if option.endswith(".toml") else option
                   for option in COMMANDS[command]]
        for name, case in CASES.items():
            if not (source / case).exists():
                sys.exit(f"{case} is not there: build the tests first")
            answers = []
            for program in programs:
                with tempfile.TemporaryDirectory() as folder:
                    # Named as from the source folder: what a report says of its files is the same.
                    os.symlink(source / "cases", pathlib.Path(folder) / "cases")
                    os.symlink(source / "build", pathlib.Path(folder) / "build")
                    answers.append(answer(program, command, case, options, pathlib.Path(folder)))
            (old_code, old_text, old), (new_code, new_text, new) = answers
            renamed = {key["before"]: key["now"] for key in (new or {}).pop("renamed_keys", [])}
            (old or {}).pop("renamed_keys", None)
            found = differences(with_present_keys(old, renamed), new, arguments.tolerance)
            if arguments.numbers:
                found = [one for one in found if is_number(one[1]) and is_number(one[2])]
            text = "same text" if old_text == new_text else "another text"
            print(f"{command}, {name}: exit codes {old_code} and {new_code}, {text}, "
                  f"{len(found)} values differ", flush=True)
            for path, a, b in found[:20]:
                print(f"  {path}: {json.dumps(a)[:70]} -> {json.dumps(b)[:70]}")
            unequal += bool(found) or old_code != new_code
    return 1 if unequal else 0


if __name__ == "__main__":
    check_itself()
    sys.exit(main())
