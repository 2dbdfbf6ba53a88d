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

from json_schema_test import numbers
from report_runs import BIG, PROGRAM, SOURCE, refuse_constant, run
from shown_output import not_printed

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
def quick_redesign(name, threads):
    """JSON, page and text."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "case.toml").write_text(quick_case(name), encoding="utf-8")
        process = subprocess.run([PROGRAM, "redesign", "case.toml", "--details", "--json", "report.json", "--report",
                                  "report.html", "--threads", str(threads)],
                                 cwd=folder, capture_output=True, text=True, check=False)
        assert process.returncode in (DONE, INFEASIBLE), process.stderr
        return (*((pathlib.Path(folder) / file).read_text(encoding="utf-8") for file in
                  ("report.json", "report.html")), process.stdout)


def redesign(name):
    """The JSON report and the lines of the text; of the 70-m antenna those of the other tests."""
    if name == BIG:
        content, text = run("redesign", BIG)
    else:
        content, _, text = quick_redesign(name, 2)
    return json.loads(content, parse_constant=refuse_constant), text.splitlines()


def card_of(report):
    return {line["label"]: line["text"] for line in report["card"]}


# Where the report has what a line shows; other lines may show any of its numbers.
PLACES = {"Recommended": ("tuning",), "Load": ("tuning",), "Do not load": ("tuning",),
          "Error per axis": ("tuning", "time_domain"), "Cross-elevation": ("tuning", "time_domain"),
          "Gains of today": ("tuning", "time_domain"), "Budgets (mdeg)": ("tuning",),
          "Margins": ("tuning",), "Limit cycle": ("time_domain",), "Flywheels": ("matching",),
          "Next test": ("tuning",)}
# How the key of a value ends whose number stands before a unit, and what makes it that unit.
UNITS = {"mdeg": {"_mdeg": 1}, "m/s": {"_m_per_s": 1}, "kg m2": {"_kg_m2": 1}, "deg": {"_deg": 1}, "dB": {"_dB": 1},
         "rad/s": {"_rad_per_s": 1}, "1/s": {"_per_s": 1}, "Hz": {"_Hz": 1, "_rad_per_s": 0.5 / math.pi},
         "%": {"_1": 100, "value": 100}, "probability": {"_1": 1}, "": {"": 1}}
FIGURE = re.compile(r"(?<![\w.])(?P<number>\d+(?:\.\d+)?)(?!\w|/[a-z])(?=(?: (?:to|and) [\d.]+)? ?"
                    r"(?P<unit>mdeg|m/s|kg m2|deg|dB|rad/s(?!\w)|1/s|Hz|%)?)")


def shown_as(number, unit, key, value):
    """Whether a number of a card stands for that of the report: rounded, in its unit."""
    decimals = len(number.partition(".")[2])
    return any(key.endswith(end) and
               abs(abs(factor * value) - float(number)) <= 0.5000001 * 10**-decimals
               for end, factor in UNITS[unit].items())


def figures_of(label, text):
    """(number, unit) of a line; with three decimals and no unit behind it an error in mdeg or a probability."""
    # How long a test takes and which confidence an interval has are no figures of the report.
    if label == "Next test":
        text = text.partition(" moves the rms from ")[2]
    # "0.527 to 10.6 m/s" is a budget and its wind speed, and no range.
    if label.startswith("Budgets"):
        text = text.replace(" to ", ", ")
    text = text.replace("95 %", "")
    probabilities = [found.span() for found in re.finditer(r"probability [\d.]+ \([\d.]+, [\d.]+\)", text)]
    for found in FIGURE.finditer(text):
        number, unit = found["number"], found["unit"] or ""
        if any(start <= found.start() < end for start, end in probabilities):
            yield number, "probability"
        else:
            yield number, "mdeg" if not unit and re.fullmatch(r"\d+\.\d{3}", number) else unit


def is_in(report, label, number, unit):
    part = {name: report[name] for name in PLACES[label] if name in report} if label in PLACES else {
        name: value for name, value in report.items() if name != "card"}
    return any(shown_as(number, unit, key, value) for key, value in numbers(part))


class Card(unittest.TestCase):
    def test_comes_first_on_one_screen(self):
        for name in (BIG, *QUICK):
            with self.subTest(case=name):
                lines = redesign(name)[1]
                heading = next(i for i, line in enumerate(lines) if line.startswith("---"))
                # Below the two lines of the title, above the first heading, between two blank lines.
                self.assertLessEqual(heading - 1 - 2 - 2, LINES, lines[:heading])
                self.assertTrue(lines[3].strip().startswith(VERDICTS), lines[3])

    def test_does_not_depend_on_threads(self):
        one, two = (quick_redesign("dss14-70m/campaign.toml", threads) for threads in (1, 2))
        for name, first, second in zip(("JSON", "page", "text"), one, two):
            # The command that the page states names the number of threads.
            self.assertTrue(first.replace("--threads 1", "") == second.replace("--threads 2", ""), name)

    def test_names_the_sections_with_its_evidence(self):
        for name in (BIG, *QUICK):
            report, headings = redesign(name)
            for line in report["card"]:
                with self.subTest(case=name, line=line["label"]):
                    self.assertTrue(any(heading.startswith(line["evidence"]) for heading in headings))

    def test_has_the_figures_of_the_report(self):
        for name in (BIG, *QUICK):
            report = redesign(name)[0]
            card = card_of(report)
            for budget in report["tuning"]["budgets"]:  # "0.1 dB mean loss"
                card["Budgets (mdeg)"] = card["Budgets (mdeg)"].replace(f" ({budget['name']})", "")
            self.assertGreater(sum(len(list(figures_of(*line))) for line in card.items()), 20)
            for label, text in card.items():
                for number, unit in figures_of(label, text):
                    with self.subTest(case=name, label=label, number=number):
                        self.assertTrue(is_in(report, label, number, unit), text)

    def test_is_what_the_documents_show(self):
        # The two quickest of docs/cards.md; ./dev screenshots writes all five.
        page = (SOURCE / "docs/cards.md").read_text(encoding="utf-8").replace("\n    ", "\n")
        name = "dss14-64m/case.toml"
        other = subprocess.run([PROGRAM, "redesign", f"cases/{name}"], cwd=SOURCE, capture_output=True, text=True,
                               check=True).stdout.splitlines()
        for case, lines in ((f"cases/{BIG}/case.toml", redesign(BIG)[1]), (f"cases/{name}", other)):
            with self.subTest(case=case):
                section = page.split(f"boresight redesign {case}\n")[1].split("\n## ")[0]
                shown = [line for line in section.splitlines() if line.startswith("  ")]
                self.assertEqual(len(shown), lines.index("", 3) - 3)
                self.assertEqual(not_printed(shown, lines), [])

    def test_would_miss_wrong_figures(self):
        report = redesign(BIG)[0]
        wrong = [(label, f"{float(number) + 0.037:.3f}", unit) for label, text in card_of(report).items()
                 for number, unit in figures_of(label, text) if unit and "." in number]
        taken = [one for one in wrong if is_in(report, *one)]
        self.assertLess(len(taken), 0.3 * len(wrong), taken)

    def test_names_the_controller_with_its_gains(self):
        loops = redesign("bwg-34m/case.toml")[0]
        line = card_of(loops).get("Recommended") or card_of(loops)["Load"]
        self.assertEqual(line.count(" = "), len(loops["tuning"]["design"]["gains"]))
        report = redesign(BIG)[0]
        card = card_of(report)
        self.assertIn(report["tuning"]["design"]["structure"], card["Recommended"])
        self.assertIn(f"best loops {report['tuning']['loops']['structure']}, ", card["Recommended"])
        expected = report["time_domain"]["expected_rms"]
        self.assertIn(f"{expected['rms_mdeg']:.3f} mdeg rms at ", card["Error per axis"])
        self.assertIn(f"95 % {expected['lower_mdeg']:.3f} to {expected['upper_mdeg']:.3f} over "
                      f"{expected['records']} winds", card["Error per axis"])
        self.assertRegex(card["Confidence"], "^low: inertias and resonance contradict")

    def test_takes_the_best_of_the_seeds(self):
        for name in ("bwg-34m/case.toml", "xy-13m/case.toml"):
            tuning = redesign(name)[0]["tuning"]
            with self.subTest(case=name):
                self.assertEqual([seed["seed"] for seed in tuning["seeds"]], list(range(1, 9)))
                best = min(seed["boresight_rms_mdeg"] for seed in tuning["seeds"] if seed["verified"])
                self.assertAlmostEqual(tuning["design"]["boresight_rms_mdeg"], best, delta=1e-4 * best)

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
