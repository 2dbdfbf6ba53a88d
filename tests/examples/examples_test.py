"""Runs the programs of examples/ and checks the figures they print: against formulas worked out here,
against one another, and against what `boresight redesign` prints of the same antenna (README.md).

usage: examples_test.py FOLDER_OF_THE_PROGRAMS
"""

import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(sys.argv[1])
SOURCE = pathlib.Path(__file__).resolve().parents[2]
SCRATCH = tempfile.TemporaryDirectory()
STIFFNESS, LEAKAGE, FRICTION = 52.608, 1.219, 0.9  # of the antenna, as in README.md


def run(name, *arguments, status=0):
    """What the program printed, and its error output."""
    done = subprocess.run([PROGRAMS / name, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != status:
        raise AssertionError(f"{name}: exit code {done.returncode}: {done.stderr}")
    return done.stdout if status == 0 else done.stderr


def small_case():
    """The 70-m antenna with two structures and few plants, so that tuning takes a moment."""
    text = (SOURCE / "cases/dss14-70m/case.toml").read_text(encoding="utf-8")
    path = pathlib.Path(tempfile.mkdtemp(dir=SCRATCH.name)) / "case.toml"
    path.write_text(text + "\n[ensemble]\ndraws = 1\n\n[tuning]\nstructures = ['PI', 'DPF']\nstarts = 2\n",
                    encoding="utf-8")
    return path


def figure(text, label):
    """The number behind `label` and a colon."""
    return float(re.search(rf"^{re.escape(label)}: ([-+.\de]+)", text, re.M).group(1))


class Examples(unittest.TestCase):
    def test_reflected_inertia_is_that_of_the_masses(self):
        text = run("reflected_inertia")
        ratio = 134 / 20 * 101 / 21 * 113 / 23 * 77 / 20 * 754 / 16
        motors, gears, dish = 4 * 0.3007, 0.217088, 3.2766e8 / ratio**2
        self.assertAlmostEqual(figure(text, "gear ratio"), ratio, delta=0.06)
        self.assertAlmostEqual(figure(text, "reflected inertia kg.m2"), motors + gears + dish,
                               delta=6e-5)
        self.assertAlmostEqual(figure(text, "motor-to-load ratio"), motors / (gears + dish),
                               delta=6e-5)
        low, high = map(float, re.search(r"inertia kg.m2.* ([\d.]+) \.\. ([\d.]+)", text).groups())
        width = 1.96 * math.hypot(0.01 * motors, 0.05 * gears, 0.1 * dish)
        self.assertAlmostEqual(high - low, 2 * width, delta=0.05 * width)
        self.assertIn("86 % of its variance from: dish", text)

    def test_resonance_becomes_an_inertia(self):
        text = run("hydraulic_resonance")
        line = [(2 * length * f)**2 * 850 for length, f in ((13.11, 46.3), (15.60, 38.3))]
        self.assertAlmostEqual(figure(text, "bulk modulus by the shortest line"), line[0] / 1e6,
                               delta=0.06)
        displacement = 4 * 38.329e-6 / (2 * math.pi)
        stiffness = (0.938 * 0.9412 * sum(line) / 2 * displacement**2 *
                     (1 / 0.02455 + 1 / 0.02457))
        self.assertAlmostEqual(figure(text, "oil stiffness"), stiffness, delta=6e-4)
        inertia = stiffness / (2 * math.pi * 0.97)**2
        self.assertAlmostEqual(figure(text, "reflected inertia at 0.970 Hz"), inertia, delta=6e-5)
        back = run("hydraulic_resonance",
                   str(figure(text, "resonance by the drawings' masses")))
        self.assertIn(": 1.817", back)

    def test_a_frequency_that_is_none_is_refused(self):
        self.assertIn("hydraulic_resonance: ", run("hydraulic_resonance", "zero", status=2))

    def test_plant_has_the_modes_and_gains_of_the_drive(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bode.csv"
            text = run("plant_bode", str(path))
            lines = path.read_text(encoding="utf-8").splitlines()
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]
        self.assertRegex(text, r"0\.8482 Hz  damping 0\.1519 .*oil and gear springs")
        self.assertEqual(len(re.findall(r"^.* Hz  damping", text, re.M)), 9)
        first = rows[0]
        self.assertAlmostEqual(first["frequency_hz"], 0.01, delta=1e-9)
        # At rest friction takes its torque from leaking oil: w = K xv/(K + leakage friction).
        slow = 20 * math.log10(STIFFNESS / (STIFFNESS + LEAKAGE * FRICTION))
        self.assertAlmostEqual(first["tachometer_db"], slow, delta=0.01)
        integrator = -20 * math.log10(2 * math.pi * 0.01)
        self.assertAlmostEqual(first["boresight_db"], slow + integrator, delta=0.01)
        self.assertAlmostEqual(first["boresight_deg"], -90, delta=1)
        largest = max(rows, key=lambda row: row["tachometer_db"])
        peak = re.search(r"largest ([\d.]+) dB at ([\d.]+) Hz", text).groups()
        self.assertAlmostEqual(largest["tachometer_db"], float(peak[0]), delta=0.006)
        self.assertAlmostEqual(largest["frequency_hz"], float(peak[1]), delta=6e-4)

    def test_tuning_ends_where_the_program_ends(self):
        text = run("tune_drive")
        self.assertAlmostEqual(figure(text, "boresight rms at the sky"), 0.5099, delta=2e-4)
        self.assertAlmostEqual(figure(text, "kp (position gain)"), 10.257, delta=0.02)
        peaks = [float(peak) for peak in re.findall(r"Ms ([\d.]+)", text)]
        self.assertEqual(len(peaks), 3)
        self.assertLessEqual(max(peaks), 2.0)
        self.assertIn("limited by: sensitivity peak at valve command", text)

    def test_own_controller_is_evaluated_by_two_independent_ways(self):
        text = run("own_controller")
        rms = figure(text, "boresight rms in 10 m/s")
        # `boresight benchmark cases/dss14-70m/case.toml` of a file with these gains.
        self.assertAlmostEqual(rms, 0.5526, delta=2e-4)
        self.assertAlmostEqual(figure(text, "the same by Lyapunov equations"), rms, delta=0.005 * rms)
        self.assertLess(figure(text, "slowest pole"), 0)
        # More wind than 10 m/s does not go with less error.
        self.assertLess(figure(text, "0.527 mdeg is met up to"), 10)
        self.assertGreater(figure(text, "2 mdeg is met up to"), 10)

    def test_recommends_from_a_case_file_what_the_program_recommends(self):
        proposal = SOURCE / "cases/dss14-70m/proposals/half-flywheels.toml"
        text = run("recommend_controller", small_case(), proposal)
        rows = re.findall(r"^(recommended )?(\S+), robust: .* constraints met, ([-e\d.]+) simulated, "
                          r"limit cycle ([-e\d.]+)(, excluded)?$", text, re.M)
        self.assertEqual({row[1] for row in rows}, {"PI", "DPF"}, text)
        # The limit cycle counts by its rms; within 2 % the controller of fewer gains is taken.
        figures = {bool(row[0]): [] for row in rows}
        fit = [row for row in rows if not row[4]] or rows
        for row in fit:
            figures[bool(row[0])].append(math.hypot(float(row[2]), float(row[3]) / math.sqrt(2)))
        self.assertEqual(len(figures[True]), 1)
        self.assertLess(figures[True][0], 1.02 * min(figures[True] + figures[False]))
        self.assertRegex(text, r"(?m)^kr: [\d.]+$")
        self.assertRegex(text, r"(?m)^PI over the flywheels: the largest rms is [-e\d.]+ % above the least$")
        # `boresight evaluate` of both: as it is has the lower rms in nearly every sample.
        self.assertRegex(text, r"(?m)^worth its cost: as it is; as it is better with probability "
                               r"(1|0\.99\d*)$")

    def test_recommending_says_what_is_wrong_with_a_case_file(self):
        self.assertIn("usage", run("recommend_controller", status=2))
        self.assertIn("nowhere.toml", run("recommend_controller", "nowhere.toml", status=2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
