"""Compiles and runs what `boresight export` writes: C by two compilers and under sanitizers,
Structured Text by an interpreter of its own, functions by Octave; all on the test vectors.

usage: export_test.py PROGRAM SOURCE_FOLDER
"""

import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import structured_text

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
CASE = SOURCE / "cases/dss14-70m/case.toml"
GAINS = {
    "PI": 'structure = "PI"\nkr = "0.8"\nwi = "0.3 rad/s"\nwp = "40 rad/s"\nkp = "0.4 1/s"\n'
          'wip = "0.05 rad/s"\n',
    "FULL+L+C": 'structure = "FULL+L+C"\nkr = "1.97"\nwz = "7.5 rad/s"\nwp = "51 rad/s"\n'
                'kT = "0.5 rad/(s.N.m)"\nwd = "60 rad/s"\nkp = "5.8 1/s"\nwpp = "1.7 rad/s"\n'
                'wzp = "11 rad/s"\ncs = "0.0108 rad/(N.m)"\nwcs = "0.235 rad/s"\n',
    "FULL+L+F": 'structure = "FULL+L+F"\nkr = "1.0"\nwz = "9 rad/s"\nwp = "60 rad/s"\n'
                'kT = "0.3 rad/(s.N.m)"\nwd = "60 rad/s"\nkp = "0.8 1/s"\nwip = "0.1 rad/s"\n'
                'fzp = "5 deg"\nwpp = "1 rad/s"\nwzp = "8 rad/s"\n',
}
COMPUTER = '''
[computer]
valve_current = "40 mA"
transducer_pressure = "3000 psi"
transducer_voltage = "10 V"
encoder_counts = 4194304
encoder_zero = "-3 deg"
encoder_centre = "45 deg"
'''
# Runs every vector of the folder and prints the outputs with all their digits.
OCTAVE = """
1;
parameters = servo_parameters();
names = {%s};
for vector = {%s}
  data = dlmread(['vectors/' vector{1} '.csv'], ',', 2, 0);
  state = servo_initial_state();
  for k = 1:size(data, 1)
    for i = 1:numel(names)
      inputs.(names{i}) = data(k, 1 + i);
    end
    inputs.run = data(k, 2) > 0.5;
    if all(isfinite(inputs.encoder_counts))
      inputs.encoder_counts = int32(inputs.encoder_counts);
    end
    [outputs, state] = servo_controller(parameters, state, inputs);
    printf('%%s', vector{1});
    for name = {%s}
      printf(',%%.17g', outputs.(name{1}));
    end
    printf('\\n');
  end
end
servo_model
"""
WARNINGS = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"]


def run(command, folder, **options):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout[-2000:]}"
                             f"{done.stderr[-2000:]}")
    return done.stdout


def table(path):
    return list(csv.reader(path.read_text(encoding="utf-8").splitlines()))


class Vectors:
    """The test vectors of a folder, and their tolerances in double and single precision."""

    def __init__(self, folder):
        self.rows, self.names = {}, []
        tolerances = table(folder / "tolerances.csv")
        self.outputs = [name.removesuffix(" (double)") for name in tolerances[0][2:]
                        if name.endswith(" (double)")]
        count = len(self.outputs)
        self.double, self.single = {}, {}
        for row in tolerances[1:]:
            name = row[0].removesuffix(".csv")
            self.names.append(name)
            self.double[name] = [float(value) for value in row[2:2 + count]]
            self.single[name] = [float(value) for value in row[2 + count:]]
            lines = table(folder / row[0])
            self.inputs = lines[1][1:-count]
            self.rows[name] = [[float(value) for value in line[1:]] for line in lines[2:]]


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.scratch.name)
        cls.case = root / "case.toml"
        text = CASE.read_text(encoding="utf-8")
        cls.case.write_text(text + COMPUTER, encoding="utf-8")
        cls.folders, cls.printed = {}, {}
        for name, gains in GAINS.items():
            (root / f"{name}.toml").write_text(gains, encoding="utf-8")
            for precision in ["double", "single"]:
                cls.export(name, precision, ["--gains", root / f"{name}.toml"])
        # Without integrals its sampled form is a state space that is stable by itself.
        run([PROGRAM, "benchmark", CASE, "--gains", root / "FULL+L+C.toml", "--quiet",
             "--export-controller", root / "state_space.json"], SOURCE)
        for precision in ["double", "single"]:
            cls.export("SS", precision, ["--controller", root / "state_space.json"])

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def export(cls, name, precision, options):
        folder = pathlib.Path(cls.scratch.name) / f"{name}-{precision}"
        cls.printed[name, precision] = run(
            [PROGRAM, "export", cls.case, "--folder", folder, "--precision", precision, "--details",
             *options], SOURCE)
        cls.folders[name, precision] = folder

    def test_c_gives_the_vectors_by_both_compilers_without_warnings(self):
        for (name, precision), folder in self.folders.items():
            for compiler in ["gcc", "clang"]:
                with self.subTest(name, precision=precision, compiler=compiler):
                    run([compiler, *WARNINGS, "-O2", "-ffp-contract=off", "-o", "check",
                         "servo_controller.c", "servo_controller_test.c", "-lm"], folder)
                    self.assertNotIn("FAILED", run(["./check", "vectors"], folder))

    def test_c_test_program_fails_on_a_changed_gain(self):
        folder = self.folders["PI", "double"]
        source = (folder / "servo_controller.c").read_text()
        changed = source.replace(".rate_lag_b1 = ", ".rate_lag_b1 = 1e-9 + ")
        self.assertNotEqual(source, changed)
        (folder / "changed.c").write_text(changed)
        run(["gcc", "-std=c99", "-o", "changed", "changed.c", "servo_controller_test.c", "-lm"],
            folder)
        done = subprocess.run(["./changed", "vectors"], cwd=folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAILED", done.stdout)

    def test_c_test_program_refuses_vectors_cut_short(self):
        folder = self.folders["PI", "double"]
        short = folder / "short"
        shutil.copytree(folder / "vectors", short)
        text = (short / "chirp.csv").read_text()
        (short / "chirp.csv").write_text(text[:len(text) // 2])
        run(["gcc", "-std=c99", "-o", "whole", "servo_controller.c", "servo_controller_test.c",
             "-lm"], folder)
        done = subprocess.run(["./whole", "short"], cwd=folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("chirp.csv: expected 500 samples", done.stderr)

    def test_c_refuses_compilers_without_nan(self):
        folder = self.folders["PI", "double"]
        done = subprocess.run(["gcc", "-ffast-math", "-c", "-o", "fast.o", "servo_controller.c"],
                              cwd=folder, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("-ffast-math", done.stderr)

    def test_single_precision_keeps_three_digits_of_the_stroke(self):
        for (name, precision), folder in self.folders.items():
            vectors = Vectors(folder / "vectors")
            valve = vectors.outputs.index("valve_command")
            for vector in vectors.names:
                self.assertLess(vectors.single[vector][valve], 1e-3 * 40.0, f"{name} {vector}")

    def test_two_axes_link_into_one_program(self):
        folder = self.folders["PI", "double"]
        gains = pathlib.Path(self.scratch.name) / "PI.toml"
        run([PROGRAM, "export", self.case, "--folder", folder, "--prefix", "az", "--language", "c",
             "--gains", gains, "--quiet"], SOURCE)
        (folder / "both.c").write_text(
            '#include "az_controller.h"\n#include "servo_controller.h"\n'
            "int main(void)\n{\n  az_state a;\n  servo_state b;\n  az_initialise(&a);\n"
            "  servo_initialise(&b);\n  return a.started || b.started;\n}\n")
        run(["gcc", *WARNINGS, "-o", "both", "both.c", "az_controller.c", "servo_controller.c",
             "-lm"], folder)
        run(["./both"], folder)

    def test_c_keeps_its_limits_and_stays_a_number_on_random_inputs(self):
        fuzz = SOURCE / "tests/app/export_fuzz.c"
        for (name, precision), folder in self.folders.items():
            torque = [] if name == "PI" else ["-DREADS_TORQUE"]
            builds = {"sanitized": (["-O1", "-g", "-fsanitize=address,undefined",
                                     "-fno-sanitize-recover=all"], 300_000)}
            if name == "FULL+L+C":
                builds["fast"] = (["-O2"], 10_000_000)
            for build, (flags, steps) in builds.items():
                with self.subTest(name, precision=precision, build=build):
                    run(["gcc", *WARNINGS, *flags, *torque, f"-I{folder}", "-o", build, fuzz,
                         "servo_controller.c", "-lm"], folder)
                    run([f"./{build}", str(steps), "1"], folder)

    def test_structured_text_gives_the_vectors(self):
        for (name, precision), folder in self.folders.items():
            vectors = Vectors(folder / "vectors")
            block = structured_text.parse(
                (folder / "servo_controller.st").read_text())["SERVO_CONTROLLER"]
            types = {variable: block.variables[variable.upper()].type for variable in vectors.inputs}
            for vector in vectors.names:
                with self.subTest(name, precision=precision, vector=vector):
                    self.run_block(block, types, vectors, vector, precision)

    def run_block(self, block, types, vectors, vector, precision):
        instance = block.instance()
        convert = {"BOOL": lambda value: value > 0.5, "DINT": int, "REAL": float, "LREAL": float}
        tolerances = (vectors.double if precision == "double" else vectors.single)[vector]
        for row in vectors.rows[vector]:
            inputs = dict(zip(vectors.inputs, row))
            instance.call(**{key: convert[types[key]](value) for key, value in inputs.items()})
            expected = row[len(vectors.inputs):]
            for output, value, tolerance in zip(vectors.outputs, expected, tolerances):
                self.assertLessEqual(abs(float(instance[output.upper()]) - value), tolerance, output)

    def test_octave_gives_the_vectors_and_blocks_are_the_state_space(self):
        for name in [*GAINS, "SS"]:
            folder = self.folders[name, "double"]
            vectors = Vectors(folder / "vectors")
            script = OCTAVE % (", ".join(f"'{key}'" for key in vectors.inputs),
                               ", ".join(f"'{vector}'" for vector in vectors.names),
                               ", ".join(f"'{output}'" for output in vectors.outputs))
            (folder / "check.m").write_text(script)
            printed = run(["octave", "--no-gui", "--quiet", "--norc", "check.m"], folder).splitlines()
            lines = [line.split(",") for line in printed if line.count(",") == len(vectors.outputs)]
            expected = [(vector, row[len(vectors.inputs):]) for vector in vectors.names
                        for row in vectors.rows[vector]]
            self.assertEqual(len(lines), len(expected))
            for line, (vector, row) in zip(lines, expected):
                self.assertEqual(line[0], vector)
                for found, value, bound in zip(map(float, line[1:]), row, vectors.double[vector]):
                    self.assertLessEqual(abs(found - value), bound)
            difference = [line for line in printed if line.startswith("Blocks and state space")][0]
            self.assertLess(float(difference.split()[6]), 1e-11)

    def test_vectors_saturate_wrap_and_fault(self):
        for name in [*GAINS, "SS"]:
            vectors = Vectors(self.folders[name, "double"] / "vectors")
            self.assertEqual(vectors.names, ["steps", "chirp", "saturation", "wrap", "modes"])
            valve, fault = (len(vectors.inputs) + vectors.outputs.index(output)
                            for output in ["valve_command", "fault"])
            counts = vectors.inputs.index("encoder_counts")
            at_limit = [abs(row[valve]) for row in vectors.rows["saturation"]]
            self.assertAlmostEqual(max(at_limit), 40.0, places=9)
            self.assertLess(min(at_limit[120:]), 20.0, "recovers")
            around = [row[counts] for row in vectors.rows["wrap"]]
            jumps = [after - before for before, after in zip(around, around[1:])
                     if abs(after - before) > 2_000_000]
            self.assertTrue(min(jumps) < 0 < max(jumps))
            faults = [row[fault] for row in vectors.rows["modes"]]
            self.assertEqual(sum(faults), 6)
            self.assertTrue(all(row[valve] == 0 for row in vectors.rows["modes"] if row[fault]))
            self.assertTrue(any(math.isnan(value) for row in vectors.rows["modes"] for value in row))

    def test_gains_written_are_read_to_the_last_bit(self):
        for name in GAINS:
            folder = self.folders[name, "double"]
            again = folder / "again"
            run([PROGRAM, "export", self.case, "--folder", again, "--language", "json", "--gains",
                 folder / "gains.toml", "--quiet"], SOURCE)
            first, second = (json.loads((place / "servo_controller.json").read_text())
                             for place in [folder, again])
            self.assertEqual(first["parameters"], second["parameters"])
            self.assertEqual(first["gains"], second["gains"])
        folder = self.folders["SS", "double"]
        run([PROGRAM, "export", self.case, "--folder", folder / "again", "--language", "json",
             "--controller", folder / "state_space.json", "--quiet"], SOURCE)
        first, second = (json.loads((place / "servo_controller.json").read_text())
                         for place in [folder, folder / "again"])
        self.assertEqual(first["parameters"], second["parameters"])

    def test_heads_name_antenna_and_source(self):
        for name in GAINS:
            for file in ["servo_controller.c", "servo_controller.st", "servo_controller.m"]:
                head = (self.folders[name, "double"] / file).read_text()[:4000]
                self.assertIn("Antenna: DSS-14, 70-m antenna, elevation axis; case ", head)
                self.assertRegex(head, rf"Controller: .*{re.escape(name)}\.toml")

    def test_scales_are_those_of_the_case(self):
        parameters = {entry["name"]: entry["value"] for entry in json.loads(
            (self.folders["FULL+L+C", "double"] / "servo_controller.json").read_text())["parameters"]}
        self.assertAlmostEqual(parameters["valve_scale"], 40.0 / 150.0, places=15)
        self.assertEqual(parameters["counts_per_turn"], 4194304)
        self.assertAlmostEqual(parameters["encoder_zero"], -3.0, places=12)
        # 2000 psi of supply make 315.62 N m: 3000 psi at 10 V.
        self.assertAlmostEqual(parameters["torque_per_pressure"], 315.62 * 1.5 / 10.0, delta=0.01)
        # 600 rpm at 157 V, 130 teeth on 23.
        self.assertAlmostEqual(parameters["rate_per_tachometer"],
                               600.0 * 2.0 * math.pi / 60.0 * 130.0 / 23.0 / 157.0, places=9)
        self.assertNotIn("DEFAULT", self.printed["FULL+L+C", "double"])

    def test_defaults_are_named(self):
        folder = pathlib.Path(self.scratch.name) / "defaults"
        text = run([PROGRAM, "export", CASE, "--folder", folder, "--language", "json", "--gains",
                    pathlib.Path(self.scratch.name) / "PI.toml"], SOURCE)
        self.assertIn("defaults stand for: encoder, valve command",
                      " ".join(text.split()))

    def test_details_print_feedforward_and_limits_with_units(self):
        text = self.printed["FULL+L+C", "double"]
        for row in ["feedforward_acceleration_to_valve", "friction_coulomb", "command_limit",
                    "rate_limit", "acceleration_limit"]:
            self.assertIn(row, text)
        self.assertIn("anti_windup", self.printed["PI", "double"])

    def test_refuses_a_case_without_simulation(self):
        done = subprocess.run([PROGRAM, "export", SOURCE / "cases/dss14-64m/case.toml",
                               "--folder", pathlib.Path(self.scratch.name) / "none"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("[simulation]", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
