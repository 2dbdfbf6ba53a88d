"""Holds `boresight benchmark --before --after` against records made here, with and without a
change, and its JSON against docs/change.schema.json.

usage: change_test.py PROGRAM SOURCE_FOLDER
"""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import jsonschema

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
CASE = str(SOURCE / "cases/dss14-70m/case.toml")
SCHEMA = json.loads((SOURCE / "docs/change.schema.json").read_text(encoding="utf-8"))
GAINS = {"kr": "1.2", "wi": "2 rad/s", "wp": "300 rad/s", "kT": "0.2 rad/(s.N.m)",
         "wd": "5.5 rad/s", "kp": "0.8 1/s", "wip": "0.2 rad/s"}
OLD = dict(GAINS, kp="0.4 1/s")


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON")


def record(speed, gain, seed, direction=200):
    """Position errors of a first-order loop in first-order gusts, as a recorder writes them."""
    numbers = random.Random(seed)
    lines = ["time [s],position error [mdeg],wind speed [km/h],wind direction [deg]"]
    gust = error = 0.0
    for k in range(3000):
        gust += 0.05 * (numbers.gauss(0.0, 1.0) - gust)
        wind = speed * (1.0 + 0.8 * gust)
        error += 0.1 * (wind * wind - speed * speed - error)
        lines.append(f"{0.2 * k:.1f},{gain * error:.6f},{3.6 * wind:.4f},{direction}")
    return "\n".join(lines) + "\n"


class Change(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        gains = self.path / "new.toml"
        gains.write_text('structure = "DPF"\n' + "".join(f'{key} = "{value}"\n' for key, value in GAINS.items()),
                         encoding="utf-8")
        self.common = ["--gains", str(gains), "--threads", "2"]

    def records(self, name, gain, slowest, count=6, direction=200):
        files = []
        for i in range(count):
            file = self.path / f"{name}{i}.csv"
            file.write_text(record(slowest + 0.7 * i, gain, f"{name}{i}", direction),
                            encoding="utf-8")
            files.append(str(file))
        return files

    def run_program(self, before, after, *more):
        return subprocess.run(
            [PROGRAM, "benchmark", CASE, *self.common, "--before", *before, "--after", *after,
             *more], capture_output=True, text=True, check=False)

    def report(self, before, after, *more):
        done = self.run_program(before, after, "--json", "-", *more)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        report = json.loads(done.stdout, parse_constant=refuse_constant)
        jsonschema.Draft202012Validator(SCHEMA).validate(report)
        return report

    def test_finds_an_improvement_at_equal_wind(self):
        old = [f"{key}={value}" for key, value in OLD.items()]
        report = self.report(self.records("before", 0.05, 5.0), self.records("after", 0.03, 6.0),
                             "--old-gains", *old)
        ratio = report["at_reference"]["ratio"]
        self.assertEqual(report["at_reference"]["change"], "better")
        self.assertLess(ratio["lower_1"], 0.6)
        self.assertGreater(ratio["upper_1"], 0.6)
        self.assertTrue(math.isclose(report["by_coherence"]["value_1"], 0.6, rel_tol=0.02))
        self.assertIsNotNone(report["predicted"])
        self.assertEqual(report["error"], "position error")
        self.assertEqual({gain["symbol"] for gain in report["old_controller"]["gains"]}, set(OLD))
        self.assertAlmostEqual(report["before"]["wind_direction_deg"], 200.0)
        passed = {check["check"]: check["passed"] for check in report["checks"]}
        self.assertTrue(passed["improvement"] and passed["wind_overlap"])
        self.assertTrue(passed["wind_direction"])

    def test_calls_no_change_a_change_and_does_not_know_the_old_gains(self):
        report = self.report(self.records("one", 0.05, 5.0), self.records("two", 0.05, 6.0))
        self.assertEqual(report["at_reference"]["change"], "no significant change")
        self.assertIsNone(report["predicted"])
        self.assertIsNone(report["old_controller"])

    def test_gives_no_verdict_for_winds_that_do_not_overlap(self):
        done = self.run_program(self.records("calm", 0.05, 2.0), self.records("storm", 0.05, 9.0))
        self.assertEqual(done.returncode, 3)
        self.assertIn("No verdict: the mean wind speeds do not overlap", done.stdout)
        self.assertNotIn("times that before", done.stdout)

    def test_writes_a_change_record_of_one_page(self):
        file = self.path / "record.html"
        done = self.run_program(self.records("before", 0.05, 5.0),
                                self.records("after", 0.03, 7.0, direction=260),
                                "--change-record", str(file))
        self.assertIn("times that before, at a mean wind speed of", done.stdout)
        self.assertIn("different directions", done.stdout)
        html = file.read_text(encoding="utf-8")
        xml.etree.ElementTree.fromstring(html.split("\n", 1)[1])
        for part in ("Change record", "times that before, at a mean wind speed of", "kr", "Checks", "initials"):
            self.assertIn(part, html)

    def test_refuses_half_a_comparison_and_files_without_wind(self):
        files = self.records("before", 0.05, 5.0, count=1)
        done = subprocess.run([PROGRAM, "benchmark", CASE, "--before", *files],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected files for both --before and --after", done.stderr)
        still = self.path / "still.csv"
        still.write_text("\n".join(line.rsplit(",", 2)[0] for line in
                                   record(5.0, 0.05, "still").splitlines()), encoding="utf-8")
        done = self.run_program(files, [str(still)])
        self.assertEqual(done.returncode, 2)
        self.assertIn("still: expected a column of the wind speed, found none", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
