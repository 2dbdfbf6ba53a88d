"""Has Octave read the MAT files that the program writes, and holds what it makes of them against the
program's own numbers: poles of the plant, its frequency response, gains, controllers, a record.

usage: octave_test.py PROGRAM SOURCE_FOLDER
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
CASE = SOURCE / "cases/dss14-70m/case.toml"
# Prints what it read as JSON by hand: numbers with 17 digits.
SCRIPT = """
1;  % a script, no function file
function show(name, values)
  printf('"%s": [', name);
  printf('%.17g,', values);
  printf('null],\\n');
end
function names(name, cells)
  printf('"%s": [', name);
  printf('"%s",', cells{:});
  printf('null],\\n');
end
m = load(argv(){1});
printf('{\\n');
names('variables', fieldnames(m));
names('states', m.plant.states);
names('outputs', m.plant.outputs);
names('output_units', m.plant.output_units);
p = eig(m.plant.A);
show('pole_real', real(p));
show('pole_imaginary', imag(p));
f = m.plant_response;
n = rows(m.plant.A);
difference = 0;
for k = 1:10:numel(f.frequency_Hz)
  s = 2i*pi*f.frequency_Hz(k);
  g = m.plant.C*((s*eye(n) - m.plant.A)\\m.plant.B) + m.plant.D;
  difference = max(difference, max(max(abs(g - f.response(:,:,k))./abs(g))));
end
show('response_size', size(f.response));
show('response_difference', difference);
show('A', m.plant.A');
show('inertia', m.parameters.reflected_inertia_kg_m2);
if isfield(m, 'gains')
  for k = 1:numel(m.gains.symbols)
    show(['gain_' m.gains.symbols{k}], m.gains.(m.gains.symbols{k}));
  end
  show('sample_time', m.sampled_controller.Ts);
  show('closed_loop_abscissa', max(real(eig(m.closed_loop.A))));
  % Every break's sensitivity, by its exact loop gain.
  for name = {'rate_loop_alone', 'valve_command', 'position_loop'}
    show(['peak_' name{1}], max(abs(1./(1 + squeeze(m.loop_gain.(name{1}))))));
  end
end
printf('"done": true}\\n');
"""


def program(*arguments, folder):
    subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, check=True, capture_output=True)


def octave(folder, script, *arguments):
    (folder / "script.m").write_text(script, encoding="utf-8")
    # Its exit status tells; what it prints to standard error while leaving does not.
    shown = subprocess.run(["octave-cli", "--quiet", "--no-history", "--no-init-file", "script.m",
                            *map(str, arguments)],
                           cwd=folder, check=True, capture_output=True, text=True)
    found = json.loads(shown.stdout)
    return {key: value[:-1] if isinstance(value, list) else value for key, value in found.items()}


def elements(rows):
    return [number for row in rows for number in row]


class Octave(unittest.TestCase):
    def check_plant(self, seen, report):
        plant = report["linear_models"]["plant"]
        self.assertEqual(seen["states"], plant["states"])
        self.assertEqual(seen["outputs"], plant["outputs"])
        self.assertEqual(seen["output_units"], plant["output_units"])
        self.assertEqual(seen["A"], elements(plant["A"]))
        self.assertEqual(seen["response_size"][:2], [4, 2])
        self.assertGreater(seen["response_size"][2], 400)
        self.assertLess(seen["response_difference"][0], 1e-8)

    def test_has_the_plants_poles(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            program("model", CASE, "--mat", "plant.mat", "--json", "report.json", folder=folder)
            report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
            seen = octave(folder, SCRIPT, "plant.mat")
        self.check_plant(seen, report)
        poles = [complex(*pair) for pair in zip(seen["pole_real"], seen["pole_imaginary"])]
        for mode in report["plant"]["modes"]:
            own = complex(mode["pole_real_rad_per_s"], mode["pole_imaginary_rad_per_s"])
            nearest = min(poles, key=lambda pole: abs(pole - own))
            # The antenna's free turn is a pole at 0.
            scale = abs(own) if abs(own) > 1e-6 else max(map(abs, poles))
            self.assertLess(abs(nearest - own), 1e-12 * scale, own)
        self.assertEqual(seen["inertia"], [report["plant"]["reflected_inertia_kg_m2"]])
        self.assertNotIn("controller", seen["variables"])

    def test_has_the_tuned_loops(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            program("tune", CASE, "--structure", "PI", "--starts", "2", "--no-limit", "--mat", "tuned.mat",
                    "--json", "report.json", folder=folder)
            report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
            seen = octave(folder, SCRIPT, "tuned.mat")
            scores = []
            for controller in ("tuned.mat", "report.json"):
                for part in ("controller", "sampled_controller"):
                    sheet = f"{part}-{controller}.json"
                    program("benchmark", CASE, "--controller", controller, "--part", part,
                            "--json", sheet, folder=folder)
                    scores.append(json.loads((folder / sheet).read_text(encoding="utf-8"))["score"])
        self.check_plant(seen, report)
        # The same controller from either file is the same score, and the continuous one is the controller's.
        self.assertEqual(scores[0], scores[2])
        self.assertEqual(scores[1], scores[3])
        self.assertNotEqual(scores[0], scores[1])
        robust = next(one for one in report["tuned"]["controllers"] if one["tuned_for"] == "robust")
        rms = scores[0]["design_wind"]["boresight_rms_mdeg"]
        self.assertLess(abs(rms / robust["design"]["boresight_rms_mdeg"] - 1), 1e-6)
        for gain in robust["gains_as_written"]:
            value = float(gain["value"].split()[0])
            self.assertLess(abs(seen["gain_" + gain["symbol"]][0] / value - 1), 1e-4, gain)
        self.assertEqual(seen["sample_time"],
                         [report["linear_models"]["sampled_controller"]["sample_time"]])
        self.assertLess(seen["closed_loop_abscissa"][0], 0)
        for cut in robust["design"]["loop_breaks"]:
            peak = seen["peak_" + cut["loop_break"].replace(" ", "_")][0]
            self.assertLess(abs(peak / cut["sensitivity_peak_1"] - 1), 1e-3, cut["loop_break"])

    def test_has_a_simulated_record(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for kind in ("mat", "csv"):
                program("simulate", CASE, "slosh", "--format", kind, folder=folder)
            header, *lines = (line for line in (folder / "slosh.csv").read_text().splitlines()
                              if not line.startswith("#"))
            seen = octave(folder, SCRIPT_OF_RECORD, "slosh.mat")
        self.assertEqual(header, ",".join(f"{name} [{unit}]" for name, unit in
                                          zip(seen["names"], seen["units"])))
        self.assertEqual(seen["size"], [len(lines), len(seen["names"])])
        for number, line in ((0, lines[0]), (1, lines[-1])):
            for cell, value in zip(line.split(","), seen["first" if number == 0 else "last"]):
                decimals = len(cell.partition(".")[2])
                self.assertLessEqual(abs(float(cell) - value), 0.51 * 10.0 ** -decimals, cell)


SCRIPT_OF_RECORD = """
m = load(argv(){1});
all = fieldnames(m);
names = all(!cellfun(@(n) strcmp(n, 'comment') || regexp(n, '_unit$', 'once'), all));
printf('{"names": [');
printf('"%s",', names{:});
printf('null], "units": [');
for k = 1:numel(names) printf('"%s",', m.([names{k} '_unit'])); end
values = cell2mat(cellfun(@(n) m.(n), names', 'UniformOutput', false));
printf('null], "size": [%d,%d,null],\\n', size(values));
printf('"first": ['); printf('%.17g,', values(1,:)); printf('null],\\n');
printf('"last": ['); printf('%.17g,', values(end,:)); printf('null]}\\n');
"""

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
