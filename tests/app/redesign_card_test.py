"""The card with which a redesign begins: on one screen, with the figures of the report.

Run by reports_test.py.
"""

import functools
import json
import math
import pathlib
import re
import subprocess
import tempfile
import unittest

from json_schema_test import BIG, PROGRAM, SOURCE, numbers, refuse_constant, run

# The other antennas, with a search small enough for a test: what is checked is the card.
SMALL_SEARCH = """
[tuning]
structures = ["PI-0", "PI"]
starts = 2

[ensemble]
draws = 4
"""
RECORDS = ("fast-ramp", "constant-speed-1V", "constant-speed-8V", "valve-steps")
QUICK = ("dss14-70m/campaign.toml", "dss14-64m/case.toml", "bwg-34m/case.toml", "xy-13m/case.toml")
VERDICTS = ("Load", "Recommended", "Do not load")
LINES = 16
DONE, INFEASIBLE = 0, 3


def quick_case(name):
    """The case with a small search, two flywheel counts and a few of its records."""
    folder = (SOURCE / "cases" / name).resolve().parent
    common, *entries = (SOURCE / "cases" / name).read_text(encoding="utf-8").split("[[record]]")
    wanted = [entry.replace('file = "', f'file = "{folder}/') for entry in entries
              if any(f"/{record}.csv" in entry for record in RECORDS)]
    text = "[[record]]".join((common, *wanted))
    most = re.search(r"^most_disks = (\d+)", text, re.M)
    if most:
        text = re.sub(r"^step = \d+", f"step = {most.group(1)}", text, flags=re.M)
    return text + SMALL_SEARCH


@functools.lru_cache(maxsize=None)
def redesign(name):
    """The JSON report and the lines of the text; of the 70-m antenna those of the other tests."""
    if name == BIG:
        content, text = run("redesign", BIG)
        return json.loads(content, parse_constant=refuse_constant), text.splitlines()
    with tempfile.TemporaryDirectory() as folder:
        case, report = pathlib.Path(folder) / "case.toml", pathlib.Path(folder) / "report.json"
        case.write_text(quick_case(name), encoding="utf-8")
        process = subprocess.run([PROGRAM, "redesign", str(case), "--details", "--json", str(report)],
                                 cwd=SOURCE, capture_output=True, text=True, check=False)
        assert process.returncode in (DONE, INFEASIBLE), process.stderr
        return (json.loads(report.read_text(encoding="utf-8"), parse_constant=refuse_constant),
                process.stdout.splitlines())


def card_of(report):
    return {line["label"]: line["text"] for line in report["card"]}


def shown_as(text, value):
    """Whether a number of a card stands for that of the report: rounded, in Hz for rad/s, in dB or in
    per cent."""
    decimals = len(text.partition(".")[2])
    values = [value, value / (2 * math.pi), 100 * value]
    values += [20 * math.log10(value)] if value > 0 else []
    return any(abs(abs(one) - abs(float(text))) <= 0.5000001 * 10**-decimals for one in values)


def figures_of(label, text):
    # How long a test takes and which confidence an interval has are no figures of the report.
    if label == "Next test":
        text = text.partition(" moves the rms from ")[2]
    return re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?![\w])", text.replace("95 %", ""))


class Card(unittest.TestCase):
    def test_comes_first_on_one_screen(self):
        for name in (BIG, *QUICK):
            with self.subTest(case=name):
                lines = redesign(name)[1]
                heading = next(i for i, line in enumerate(lines) if line.startswith("---"))
                # Below the two lines of the title, above the first heading, between two blank lines.
                self.assertLessEqual(heading - 1 - 2 - 2, LINES, lines[:heading])
                self.assertTrue(lines[3].strip().startswith(VERDICTS), lines[3])

    def test_names_the_sections_with_its_evidence(self):
        for name in (BIG, *QUICK):
            report, headings = redesign(name)
            for line in report["card"]:
                with self.subTest(case=name, line=line["label"]):
                    self.assertTrue(any(heading.startswith(line["evidence"]) for heading in headings))

    def test_has_the_figures_of_the_report(self):
        for name in (BIG, *QUICK):
            report = redesign(name)[0]
            values = [value for _, value in numbers({key: value for key, value in report.items()
                                                     if key != "card"})]
            card = card_of(report)
            self.assertGreater(sum(len(figures_of(*line)) for line in card.items()), 20)
            for label, text in card.items():
                for number in figures_of(label, text):
                    with self.subTest(case=name, label=label, number=number):
                        self.assertTrue(any(shown_as(number, value) for value in values), text)

    def test_names_the_controller_with_its_gains(self):
        report = redesign(BIG)[0]
        card = card_of(report)
        self.assertEqual(card["Recommended"].count(" = "), len(report["tuning"]["design"]["gains"]))
        expected = report["time_domain"]["expected_rms"]
        self.assertIn(f"{expected['rms_mdeg']:.3f} mdeg rms in ", card["Error per axis"])
        self.assertIn(f"95 % {expected['lower_mdeg']:.3f} to {expected['upper_mdeg']:.3f} over "
                      f"{expected['records']} winds", card["Error per axis"])
        self.assertRegex(card["Confidence"], "^low: inertia estimates contradict")

    def test_compares_with_the_gains_of_today_or_the_structure_tuned_again(self):
        for name in (BIG, *QUICK):
            with self.subTest(case=name):
                report = redesign(name)[0]
                tuning, text = report["tuning"], card_of(report)["Gains of today"]
                if name.startswith("bwg"):
                    self.assertFalse(tuning["present"][0]["retuned"])
                    self.assertNotIn("not given", text)
                    continue
                self.assertIn("not given", text)
                self.assertNotIn("no comparison", text)
                self.assertNotEqual(tuning["is_retuned_present"], bool(tuning["present"]))
                for present in tuning["present"]:
                    self.assertTrue(present["retuned"])
                    # Stated by the X-Y antenna, otherwise that of fewest gains.
                    self.assertEqual(present["structure"],
                                     "PI-0" if name in QUICK and not name.startswith("xy") else "PI")

    def test_names_the_error_of_the_axis(self):
        for name, label, factor in (("bwg-34m/case.toml", "Cross-elevation", math.cos(math.pi / 4)),
                                    ("xy-13m/case.toml", "Error per axis", math.cos(math.pi / 6))):
            report = redesign(name)[0]
            self.assertIn(label, card_of(report))
            self.assertAlmostEqual(report["case"]["boresight_factor_1"], factor, places=12)
