"""Holds the JSON report of `boresight commission` against docs/commission.schema.json.

usage: commission_schema_test.py PROGRAM SOURCE_FOLDER
"""

import json
import pathlib
import subprocess
import sys
import unittest

import jsonschema

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = json.loads((SOURCE / "docs/commission.schema.json").read_text(encoding="utf-8"))
GAINS = ["kr=1.2", "wi=2 rad/s", "wp=300 rad/s", "kT=0.2 rad/(s.N.m)", "wd=5.5 rad/s",
         "kp=0.8 1/s", "wip=0.2 rad/s"]


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON")


class CommissionSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text = subprocess.run(
            [PROGRAM, "commission", str(SOURCE / "cases/dss14-70m/case.toml"), "--gains", *GAINS,
             "--json", "-"], capture_output=True, text=True, check=True).stdout
        cls.report = json.loads(text, parse_constant=refuse_constant)

    def test_report_is_valid(self):
        jsonschema.Draft202012Validator(SCHEMA).validate(self.report)

    def test_open_position_loops_say_nothing_of_the_beam(self):
        for stage in self.report["stages"]:
            beam = stage["expected"]["boresight_rms_mdeg"]["nominal"]
            self.assertEqual(beam is None, stage["position_loop"] == "open")

    def test_last_stage_has_the_gains_given(self):
        last = {gain["symbol"]: gain["value_SI"] for gain in self.report["stages"][-1]["gains"]}
        self.assertEqual(last, {text.split("=")[0]: float(text.split("=")[1].split()[0])
                                for text in GAINS})
        self.assertEqual(self.report["gains_from"], "user")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
