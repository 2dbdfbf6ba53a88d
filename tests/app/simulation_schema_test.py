"""Holds the JSON report of `boresight simulate` against docs/simulation.schema.json, its text report
and the records it writes.

usage: simulation_schema_test.py PROGRAM SOURCE_FOLDER
"""

import cmath
import functools
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = json.loads((SOURCE / "docs/simulation.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
CASE = (SOURCE / "cases/dss14-70m/case.toml").read_text(encoding="utf-8")
UNITS = ("1", "Pa", "N_m", "s", "rad_per_s", "mdeg")
COUNTS = {"seed", "sliding_start_count", "samples", "contact_losses", "steps", "rejected",
          "newton_iterations", "halvings_of_interval"}


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON")


GAINS = ('\n[gains]\nstructure = "PI"\nkr = 0.043\nwi = "0.3 rad/s"\nwp = "2.5 rad/s"\n'
         'kp = "30 1/s"\nwip = "0.2 rad/s"\n')


@functools.lru_cache(maxsize=None)
def run(*tests, old="", new="", state_space=False):
    """Exit code, report, text, errors and the records' lines of a run on an edited case, with given
    gains (tests/app/readme_test.py runs the recommended controller) or the same as a state space."""
    assert old in CASE
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.toml").write_text(CASE.replace(old, new, 1) + GAINS, encoding="utf-8")
        controller = ["--gains", "case"]
        if state_space:
            subprocess.run([PROGRAM, "benchmark", "case.toml", *controller, "--sampled", "--quiet",
                            "--export-controller", "controller.json"], cwd=folder, check=True)
            controller = ["--controller", "controller.json"]
        process = subprocess.run(
            [PROGRAM, "simulate", "case.toml", *tests, "--folder", "out", "--json", "report.json",
             *controller], cwd=folder, capture_output=True, text=True, check=False)
        report = json.loads((folder / "report.json").read_text(), parse_constant=refuse_constant)
        records = {path: (folder / path).read_text().splitlines() for path in report["records"]}
        return process.returncode, report, process.stdout, process.stderr, records


def numbers(value, key=""):
    if isinstance(value, dict):
        for name, inner in value.items():
            if name != "figures":  # whose axes name their units
                yield from numbers(inner, name)
    elif isinstance(value, list):
        for inner in value:
            yield from numbers(inner, key)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield key, value


class Simulation(unittest.TestCase):
    def test_the_schema_allows_no_key_it_does_not_describe(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

        def walk(node):
            if isinstance(node, dict):
                if node.get("type") == "object":
                    self.assertIs(node.get("additionalProperties"), False, node)
                    self.assertEqual(sorted(node["required"]), sorted(node["properties"]))
                    for key, inner in node["properties"].items():
                        self.assertTrue({"description", "const", "$ref"} & inner.keys(), key)
                for inner in node.values():
                    walk(inner)
            elif isinstance(node, list):
                for inner in node:
                    walk(inner)

        # Figures have only the parts that they need.
        definitions = {name: one for name, one in SCHEMA["$defs"].items()
                       if not name.startswith("figure")}
        walk({**SCHEMA, "$defs": definitions})

    def test_reports_fit_it_and_carry_their_units(self):
        for tests, state_space in ((("slosh", "slow-ramp", "fast-ramp"), False),
                                   (("tracking", "slew"), False), (("tracking", "slew"), True)):
            code, report, _, errors, _ = run(*tests, state_space=state_space)
            self.assertEqual((code, errors), (0, ""))
            self.assertEqual([f"{list(e.absolute_path)}: {e.message[:200]}"
                              for e in VALIDATOR.iter_errors(report)], [])
            for key, value in numbers(report):
                self.assertTrue(math.isfinite(value))
                if key in COUNTS:
                    self.assertIsInstance(value, int)
                else:
                    self.assertRegex(key, rf".+_({'|'.join(UNITS)})$")
        spoilt = json.loads(json.dumps(report))
        spoilt["position_tests"][0]["events"].pop("contact_losses")
        self.assertFalse(VALIDATOR.is_valid(spoilt))

    def test_report_and_records_tell_the_same(self):
        _, report, text, _, records = run("slosh", "slow-ramp", "fast-ramp")
        self.assertEqual([r["test"] for r in report["drive_tests"]],
                         ["slosh", "slow-ramp", "fast-ramp"])
        for found in report["drive_tests"]:
            lines = records[f"out/{found['test']}.csv"]
            names = lines[0].split(",")
            rows = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
            self.assertAlmostEqual(rows[-1][0], found["duration_s"], places=6)
            tach = [row[names.index("tach [V]")] for row in rows]
            # Readings at the limit may come from just below it, by rounding, but not from above.
            limit = [i for i, volts in enumerate(tach) if abs(volts) >= 10.0 - 1e-9]
            clipped = {c["channel"]: c for c in found["clipped_channels"]}
            self.assertEqual(bool(limit), "tach" in clipped)
            if limit:
                self.assertLessEqual(clipped["tach"]["samples"], len(limit))
                self.assertGreater(clipped["tach"]["samples"], 0.95 * len(limit))
                self.assertAlmostEqual(clipped["tach"]["first_s"], rows[limit[0]][0], delta=0.05)
                self.assertAlmostEqual(clipped["tach"]["samples"] / len(rows),
                                       found["tachometer_at_limit_1"])
            self.assertRegex(text, rf"{found['test']} .*{found['largest_rate_rad_per_s']:.2f} ")

    def test_breaks_away_both_ways_at_the_curves_friction(self):
        _, report, text, _, _ = run("slosh", "slow-ramp", "fast-ramp")
        slow = report["drive_tests"][1]
        starts = slow["events"]["sliding_starts"]
        self.assertEqual([s["direction"] for s in starts], ["up", "down", "up", "down"])
        self.assertEqual(slow["events"]["sliding_start_count"], 4)
        for start in starts:
            w = start["rate_rad_per_s"]
            curve = (10.33 + 6.5 * math.exp(-(w / 0.15) ** 2) + 63.29 * (1 - math.exp(-w / 1.5))
                     + 2.075 * w)
            self.assertAlmostEqual(start["friction_N_m"] / curve, 1.0, delta=0.06)
            self.assertGreater(start["friction_N_m"], slow["curve_breakaway_N_m"])
            # Inertia apart, torque is friction with the offset, which helps upwards.
            sign = 1 if start["direction"] == "up" else -1
            self.assertAlmostEqual(sign * start["motor_torque_N_m"],
                                   start["friction_N_m"] - sign * 5.65, delta=1.5)
        self.assertIn(f"{starts[0]['friction_N_m']:.2f}", text)

    def test_a_failure_leaves_the_report_of_what_was_done(self):
        code, report, text, errors, records = run(
            "slosh", "tracking", "slew", old='design_speed = { value = "10 m/s"',
            new='design_speed = { value = "60 m/s"')  # more torque than the supply's
        self.assertEqual(code, 4)
        self.assertEqual(list(records), ["out/slosh.csv"])
        self.assertEqual([r["test"] for r in report["drive_tests"]], ["slosh"])
        self.assertEqual(report["position_tests"], [])
        self.assertEqual(report["failure"]["test"], "tracking")
        self.assertEqual(errors, f"boresight: {report['failure']['message']}\n")
        self.assertEqual(report["not_run"], ["slew"])
        self.assertTrue(VALIDATOR.is_valid(report))
        self.assertIn("FAILED in tracking", text)
        self.assertRegex(text, r"slosh +10\.0 ")

    def test_goes_to_standard_output_alone_on_request(self):
        with tempfile.TemporaryDirectory() as folder:
            shown = subprocess.run(
                [PROGRAM, "simulate", str(SOURCE / "cases/dss14-70m/case.toml"), "slosh",
                 "--folder", folder, "--json", "-"], capture_output=True, text=True, check=True)
        self.assertTrue(VALIDATOR.is_valid(json.loads(shown.stdout)))
        self.assertEqual(shown.stderr, "")

    def test_a_low_pass_takes_what_would_fold_down(self):
        line = re.search(r"^sample_rate = .*\n(?:.*\n)*?pressure_noise = .*\n", CASE, re.M).group(0)
        quiet = re.sub(r"pressure_noise = .*", 'pressure_noise = "0 psi"', line)
        ringing = []
        for new in (quiet, quiet + 'filter_order = 4\nfilter_frequency = "15 Hz"\n'):
            code, report, _, errors, records = run("slosh", old=line, new=new)
            self.assertEqual((code, errors), (0, ""))
            rows = [line.split(",") for line in records["out/slosh.csv"][1:]]
            # The lines ring at some 40 Hz after the valve closes at 2 s.
            ring = [float(row[1]) for row in rows if 2.05 < float(row[0]) < 2.45]
            window = [0.5 - 0.5 * math.cos(2 * math.pi * i / len(ring)) for i in range(len(ring))]
            ringing.append(max(
                abs(sum(w * r * cmath.exp(-2j * math.pi * f * 1e-3 * i)
                        for i, (w, r) in enumerate(zip(window, ring))))
                for f in range(36, 48)))
        self.assertLess(ringing[1], 0.25 * ringing[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
