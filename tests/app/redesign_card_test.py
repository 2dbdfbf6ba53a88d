"""The card with which a redesign begins: on one screen, with the figures of the report.

Run by reports_test.py.
"""

import json
import math
import re
import unittest

from json_schema_test import BIG, numbers, refuse_constant, run


def shown_as(text, value):
    """Whether a number of a card stands for that of the report: rounded, in Hz for rad/s, or in dB."""
    decimals = len(text.partition(".")[2])
    values = [value, value / (2 * math.pi)] + ([20 * math.log10(value)] if value > 0 else [])
    return any(abs(abs(one) - abs(float(text))) <= 0.5000001 * 10**-decimals for one in values)


class Card(unittest.TestCase):
    def setUp(self):
        content, self.text = run("redesign", BIG)
        self.report = json.loads(content, parse_constant=refuse_constant)
        self.card = {line["label"]: line["text"] for line in self.report["card"]}

    def test_comes_first_on_one_screen(self):
        lines = self.text.splitlines()
        heading = next(i for i, line in enumerate(lines) if line.startswith("---"))
        # Below the two lines of the title, above the first heading, between two blank lines.
        self.assertLessEqual(heading - 1 - 2 - 2, 16, self.text[:3000])
        self.assertIn("Recommended", lines[3])

    def test_names_the_sections_with_its_evidence(self):
        headings = self.text.splitlines()
        for line in self.report["card"]:
            self.assertTrue(any(heading.startswith(line["evidence"]) for heading in headings), line)

    def test_has_the_figures_of_the_report(self):
        values = [value for _, value in numbers({key: value for key, value in self.report.items()
                                                 if key != "card"})]
        for label, text in self.card.items():
            # How long a test takes is no figure of the report.
            if label == "Next test":
                text = text.partition(" moves the rms from ")[2]
            found = re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?![\w])", text)
            self.assertTrue(found or label in ("Gains of today", "Confidence"), (label, text))
            for number in found:
                self.assertTrue(any(shown_as(number, value) for value in values), (label, number, text))

    def test_names_the_controller_with_its_gains(self):
        tuning = self.report["tuning"]
        self.assertIn("Recommended", self.card)
        self.assertEqual(self.card["Recommended"].count(" = "), len(tuning["design"]["gains"]))
        expected = self.report["time_domain"]["expected_rms"]
        self.assertIn(f"{expected['rms_mdeg']:.3f} mdeg rms in ", self.card["Error per axis"])
        self.assertIn(f"95 % {expected['lower_mdeg']:.3f} to {expected['upper_mdeg']:.3f} over "
                      f"{expected['records']} winds", self.card["Error per axis"])
        self.assertRegex(self.card["Confidence"], "^low: inertia estimates contradict")
