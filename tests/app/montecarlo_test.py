"""Holds `boresight montecarlo` to its schema, and to itself: for any number of threads, split over
MPI, killed and taken up again.

usage: montecarlo_test.py PROGRAM SOURCE_FOLDER [PROGRAM_WITH_MPI]
"""

import csv
import json
import math
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

import jsonschema

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
MPI_PROGRAM = sys.argv[3] if len(sys.argv) > 3 else None
SCHEMA = json.loads((SOURCE / "docs/montecarlo.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
CASE = (SOURCE / "cases/dss14-70m/case.toml").read_text(encoding="utf-8")
# A controller to hold, so that nothing is tuned: as a case says what its antenna runs on.
GAINS = """
[gains]
structure = "PI"
kr = { value = "%g", basis = "assumed", source = "a test" }
wi = { value = "0.8 rad/s", basis = "assumed", source = "a test" }
wp = { value = "6 rad/s", basis = "assumed", source = "a test" }
kp = { value = "0.2 1/s", basis = "assumed", source = "a test" }
wip = { value = "0.02 rad/s", basis = "assumed", source = "a test" }
"""
CLIMATE = """
[[wind.climate]]
scale = "6 m/s"
shape = 2
highest = "20 m/s"
"""


class Folder:
    """A folder with a case in it."""

    def __init__(self, gain=0.2, more=""):
        self.scratch = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.path = pathlib.Path(self.scratch.name)
        (self.path / "case.toml").write_text(CASE + GAINS % gain + more, encoding="utf-8")

    def command(self, *arguments, name="one", program=PROGRAM):
        return [program, "montecarlo", "case.toml", "--details", "--gains", "case",
                "--json", f"{name}.json", "--csv", f"{name}.csv", *arguments]

    def run(self, *arguments, name="one", start=(), program=PROGRAM):
        return subprocess.run([*start, *self.command(*arguments, name=name, program=program)],
                              cwd=self.path, capture_output=True, text=True, check=False)

    def files(self, name="one"):
        return ((self.path / f"{name}.json").read_bytes(), (self.path / f"{name}.csv").read_bytes())

    def report(self, name="one"):
        return json.loads(self.files(name)[0])

    def rows(self, name="one"):
        return list(csv.DictReader(self.files(name)[1].decode().splitlines()))


class MonteCarlo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        cls.done = cls.folder.run("--plants", "2050", "--threads", "1")
        assert cls.done.returncode == 0, cls.done.stderr
        cls.report = cls.folder.report()

    def test_the_report_is_what_the_schema_says(self):
        VALIDATOR.validate(self.report)
        self.assertIn("Plants that are not stable", self.done.stdout)
        self.assertIn("What the numbers mean", self.done.stdout)

    def test_the_report_is_what_the_rows_say(self):
        rows = self.folder.rows()
        self.assertEqual([int(row["plant"]) for row in rows], list(range(2050)))
        stable = [float(row["boresight_rms_mdeg"]) for row in rows if row["stability_verdict"] == "stable"]
        self.assertEqual(self.report["stability"]["stable"], len(stable))
        lost = [row for row in rows if row["stability_verdict"] != "stable"]
        self.assertGreater(len(lost), 0)
        self.assertEqual([plant["index"] for plant in self.report["stability"]["not_stable_plants"]],
                         [int(row["plant"]) for row in lost])
        self.assertTrue(all(row["boresight_rms_mdeg"] == "" for row in lost))
        rms = self.report["boresight_rms_mdeg"]
        self.assertAlmostEqual(rms["mean"]["value"] / statistics.fmean(stable), 1.0, places=9)
        self.assertAlmostEqual(rms["standard_deviation"]["value"] / statistics.stdev(stable), 1.0,
                               places=6)
        median = next(row for row in rms["quantiles"] if row["fraction_1"] == 0.5)
        self.assertAlmostEqual(median["value"], statistics.median(stable), places=9)
        effect = self.report["effect"]
        factor, cycle = max(1.0, effect["factor_1"]), effect["limit_cycle_amplitude_mdeg"]
        for budget in self.report["budgets"]:
            met = sum(math.hypot(factor * value, cycle / math.sqrt(2)) <= (1 + 1e-6) * budget["rms_mdeg"]
                      for value in stable) / len(rows)
            self.assertAlmostEqual(budget["probability_met_1"]["value"], met, places=9)
        worst = self.report["worst_plants"][0]
        self.assertEqual(worst["boresight_rms_mdeg"], max(stable))
        self.assertEqual(float(rows[worst["index"]]["oil_stiffness_1"]),
                         worst["inputs"]["oil_stiffness_1"])

    def test_threads_change_no_byte(self):
        self.assertEqual(self.folder.run("--plants", "2050", "--threads", "3", name="two").returncode,
                         0)
        self.assertEqual(self.folder.files("two"), self.folder.files())

    def test_fewer_plants_are_the_first_of_more(self):
        self.folder.run("--plants", "150", name="few")
        self.assertEqual(self.folder.rows("few"), self.folder.rows()[:150])

    def test_a_controller_of_a_report_is_evaluated_to_the_last_bit(self):
        controller = self.report["controller"]
        names = [gain["name"].replace(" ", "_") for gain in controller["gains"]]
        gains = {f"{name}_x": gain["value"] for name, gain in zip(names, controller["gains"])}
        tuned = {"tuned": {"controllers": [{"structure": "PI", "tuned_for": "robust", "constraints_met": True,
                                     "boresight_rms_mdeg": 1.0, "design": {"gains": gains}}]}}
        (self.folder.path / "tuned.json").write_text(json.dumps(tuned))
        done = self.folder.run("--plants", "150", "--gains", "tuned.json", name="of_report")
        self.assertEqual(done.returncode, 2)  # --gains twice
        done = subprocess.run([PROGRAM, "montecarlo", "case.toml", "--gains", "tuned.json",
                               "--plants", "150", "--csv", "of_report.csv"], cwd=self.folder.path,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.folder.run("--plants", "150", name="few_again")
        self.assertEqual((self.folder.path / "of_report.csv").read_bytes(),
                         self.folder.files("few_again")[1])

    def test_retuning_says_what_one_controller_costs(self):
        done = self.folder.run("--plants", "100", "--retune", name="retuned")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = self.folder.report("retuned")
        VALIDATOR.validate(report)
        self.assertGreater(report["retuned"]["controllers_found"], 90)
        self.assertGreater(report["retuned"]["cost_of_fixed_gains_1"]["minimum"], -1e-4)
        self.assertIn("Fixed gains cost", done.stdout)

    def test_the_climate_has_a_distribution_of_its_own(self):
        folder = Folder(more=CLIMATE)
        self.assertEqual(folder.run("--plants", "300").returncode, 0)
        report = folder.report()
        VALIDATOR.validate(report)
        for row in folder.rows():
            if row["stability_verdict"] == "stable":
                self.assertGreater(float(row["climate_boresight_rms_mdeg"]), 0.0)
        for band in report["bands"]:
            # Most of the time the wind is weaker than the design's.
            self.assertLess(band["climate_mean_loss_two_axes_dB"]["mean"]["value"],
                            band["mean_loss_two_axes_dB"]["mean"]["value"])
        self.assertIsNone(self.report["climate_boresight_rms_mdeg"])

    def test_what_cannot_be_done_is_refused(self):
        for arguments, message in (
                (("--structure", "XYZ"), "--structure: "),
                (("--csv", "nowhere/x.csv"), "nowhere/x.csv: expected a place to write to"),
                (("--checkpoint", "case.toml"), "case.toml: expected a checkpoint of boresight")):
            done = subprocess.run([PROGRAM, "montecarlo", "case.toml", "--gains", "case", "--plants",
                                   "150", *arguments], cwd=self.folder.path, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(message, done.stderr)
        done = subprocess.run([PROGRAM, "montecarlo", "case.toml", "--gains", "case.toml"],
                              cwd=self.folder.path, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"case\.toml:\d+:\d+: \w+: .*'gains'")


class Interruption(unittest.TestCase):
    PLANTS = "100000"

    def kill_when_saved(self, folder, how):
        """Starts a run and ends it once its checkpoint is there."""
        checkpoint = folder.path / "run.checkpoint"
        process = subprocess.Popen(
            folder.command("--plants", self.PLANTS, "--threads", "1", "--checkpoint",
                           "run.checkpoint"),
            cwd=folder.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not checkpoint.exists() and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(how)
        process.communicate()
        return process.returncode, checkpoint

    def test_a_killed_run_is_taken_up_to_the_same_bytes(self):
        folder = Folder()
        code, checkpoint = self.kill_when_saved(folder, signal.SIGKILL)
        if code == 0:
            self.skipTest("the run ended before it could be killed")
        saved = checkpoint.read_bytes()
        resume = ("--plants", self.PLANTS, "--checkpoint", "run.checkpoint")
        self.assertFalse((folder.path / "one.json").exists())
        done = folder.run(*resume, name="resumed")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("taken up from run.checkpoint", done.stderr)
        self.assertEqual(folder.run("--plants", self.PLANTS, name="whole").returncode, 0)
        self.assertEqual(folder.files("resumed"), folder.files("whole"))

        # Of another run.
        done = folder.run("--plants", self.PLANTS, "--seed", "2", "--checkpoint", "run.checkpoint")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is the checkpoint of another run", done.stderr)
        # Cut off and altered, anywhere: refused, or what is whole is used.
        for place in (5, 40, 55):
            damaged = bytearray(saved)
            damaged[place] ^= 1
            checkpoint.write_bytes(damaged)
            done = folder.run(*resume, name="damaged")
            self.assertEqual(done.returncode, 2)
            self.assertIn("run.checkpoint: expected a checkpoint", done.stderr)
        for size in (0, 20, 57):
            checkpoint.write_bytes(saved[:size])
            self.assertEqual(folder.run(*resume, name="damaged").returncode, 2)
        damaged = bytearray(saved[: len(saved) * 2 // 3])
        damaged[len(damaged) // 2] ^= 1
        damaged[1000] ^= 128
        checkpoint.write_bytes(damaged)
        done = folder.run(*resume, name="damaged")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(folder.files("damaged"), folder.files("whole"))

    def test_ctrl_c_leaves_a_valid_part(self):
        folder = Folder()
        code, _ = self.kill_when_saved(folder, signal.SIGINT)
        if code == 0:
            self.skipTest("the run ended before it could be interrupted")
        self.assertEqual(code, 130)
        report = folder.report()
        VALIDATOR.validate(report)
        self.assertTrue(report["interrupted"])
        self.assertEqual(report["plants"] % 100, 0)
        self.assertEqual(len(folder.rows()), report["plants"])


class Cluster(unittest.TestCase):
    def setUp(self):
        if MPI_PROGRAM is None:
            self.skipTest("built without MPI")
        if shutil.which("mpirun") is None:
            self.skipTest("no mpirun")
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        self.start = ["mpirun", *root, "--oversubscribe", "-n", "2"]

    def test_two_ranks_give_the_bytes_of_one(self):
        folder = Folder()
        options = ("--plants", "2050", "--threads", "1")
        self.assertEqual(folder.run(*options).returncode, 0)
        done = folder.run(*options, name="split", start=self.start, program=MPI_PROGRAM)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(folder.files("split"), folder.files())
        self.assertEqual(done.stdout.count("What the numbers mean"), 1)
        # Half of it done before, and the program with MPI on its own.
        folder.run("--plants", "2050", "--checkpoint", "x.checkpoint", name="alone",
                   program=MPI_PROGRAM)
        self.assertEqual(folder.files("alone"), folder.files())
        path = folder.path / "x.checkpoint"
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
        done = folder.run(*options, "--checkpoint", "x.checkpoint", name="rest", start=self.start,
                          program=MPI_PROGRAM)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(folder.files("rest"), folder.files())

    def test_an_error_ends_all_with_one_message(self):
        folder = Folder()
        done = folder.run("--plants", "2050", "--structure", "XYZ", start=self.start,
                          program=MPI_PROGRAM)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("boresight: --structure: "), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]], verbosity=1)
