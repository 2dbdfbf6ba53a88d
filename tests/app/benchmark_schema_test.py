"""Holds score sheets of `boresight benchmark` against docs/benchmark.schema.json, of a tuned controller, a given
controller beside it, and an unstable loop.

usage: benchmark_schema_test.py PROGRAM SOURCE_FOLDER
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = json.loads((SOURCE / "docs/benchmark.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
CASE = (SOURCE / "cases/dss14-70m/case.toml").read_text(encoding="utf-8")
GAINS = """
[ensemble]
draws = 1
[gains]
structure = "PI"
kr = "{}"
wi = "0.8 rad/s"
wp = "6 rad/s"
kp = "0.2 1/s"
wip = "0.02 rad/s"
"""


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON")


def run(folder, *options, gain="0.2"):
    (folder / "case.toml").write_text(CASE + GAINS.format(gain), encoding="utf-8")
    if "--controller" not in options:
        options = ("--gains", "case", *options)
    process = subprocess.run([PROGRAM, "benchmark", "case.toml", "--json", "sheet.json", *options],
                             cwd=folder, capture_output=True, text=True, check=False)
    sheet = json.loads((folder / "sheet.json").read_text(), parse_constant=refuse_constant)
    return process.returncode, sheet


class Benchmark(unittest.TestCase):
    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_sheets_are_as_the_schema_says(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            code, tuned = run(folder, "--export-controller", "k.mat")
            self.assertEqual(code, 0)
            VALIDATOR.validate(tuned)
            (folder / "controller.json").write_text(json.dumps(tuned), encoding="utf-8")
            code, given = run(folder, "--controller", "k.mat", "--compare", "controller.json")
            self.assertEqual(code, 0)
            VALIDATOR.validate(given)
            self.assertIsNotNone(given["comparison"])
            code, unstable = run(folder, gain="8")
            self.assertEqual(code, 3)
            VALIDATOR.validate(unstable)
            self.assertIsNone(unstable["score"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
