"""Holds the figures of the JSON reports against the reports' own numbers, computed apart from them,
and against what a figure must be.

Run by reports_test.py.
"""

import bisect
import math
import re
import unittest

from report_runs import BIG, TUNED, every_report, report, run


def figures_of(found):
    return {figure["id"]: figure for figure in found.get("figures", [])}


def series_of(figure, panel, name=None):
    for series in figure["panels"][panel]["series"]:
        if name in (None, series["name"]):
            return series
    raise AssertionError(f"{figure['id']}: no series {name}")


def at(series, x):
    """The curve's value between its points, by straight lines."""
    place = bisect.bisect_left(series["x"], x)
    if place == len(series["x"]) or series["x"][place] == x:
        return series["y"][min(place, len(series["x"]) - 1)]
    fraction = (x - series["x"][place - 1]) / (series["x"][place] - series["x"][place - 1])
    return (1 - fraction) * series["y"][place - 1] + fraction * series["y"][place]


class Near(unittest.TestCase):
    def assertNear(self, found, expected, relative):
        self.assertLess(abs(found - expected), relative * abs(expected), f"{found} {expected}")


class Figures(unittest.TestCase):
    def test_are_there(self):
        for command in ("model", "redesign", "evaluate", "match"):
            self.assertGreater(len(figures_of(report(command))), 2, command)
        self.assertGreater(len(figures_of(report("tune", TUNED))), 7)

    def test_belong_to_a_section_and_say_their_conditions(self):
        for command, case, found in every_report():
            text = run(command, case, 1 if command == "match" else 2)[1]
            ids = [figure["id"] for figure in found.get("figures", [])]
            self.assertEqual(len(set(ids)), len(ids))
            for figure in found.get("figures", []):
                with self.subTest(command=command, case=case, figure=figure["id"]):
                    self.assertRegex(text, rf"(?m)^{re.escape(figure['section'])}\n-+$")
                    self.assertTrue(figure["title"])
                    self.assertRegex(figure["caption"], r"^[^a-z].*\.$")

    def test_have_points_that_can_be_drawn(self):
        for command, case, found in every_report():
            for figure in found.get("figures", []):
                with self.subTest(command=command, case=case, figure=figure["id"]):
                    self.assertTrue(figure["panels"])
                    for panel in figure["panels"]:
                        self.assertTrue(panel["series"])
                        for series in panel["series"]:
                            self.assertEqual(len(series["x"]), len(series["y"]))
                            self.assertTrue(any(y is not None for y in series["y"]))
                            for axis, values in ((figure["x"], series["x"]),
                                                 (panel["y"], series["y"])):
                                if axis["scale"] == "logarithmic":
                                    self.assertTrue(any(v is not None and v > 0 for v in values))
                                if "categories" in axis:
                                    self.assertTrue(all(-0.5 < v < len(axis["categories"]) - 0.5
                                                        for v in values if v is not None))


def breaks_of(design):
    """Where the controller has a loop: a state space is cut at the valve command only."""
    return [loop for loop in design["loop_breaks"] if loop["sensitivity_peak_1"] > 1]


def around(series, x):
    """The curve's values at its points on either side of x."""
    after = bisect.bisect_left(series["x"], x)
    return series["y"][after - 1:after + 1]


class TunedControllers(Near):
    def setUp(self):
        self.found = report("redesign")
        self.figures = figures_of(self.found)
        self.design = self.found["tuning"]["design"]

    def evaluated(self, linear):
        """What the simulation makes of a linear rms, the limit cycle's in quadrature."""
        effect = self.found["tuning"]["effect"]
        return math.hypot(max(1, effect["factor_1"]) * linear,
                          effect["limit_cycle_amplitude_mdeg"] / math.sqrt(2))

    def test_rms_against_wind_passes_through_design_and_budgets(self):
        figure = self.figures["tuned-rms-against-wind"]
        curve = series_of(figure, 0)
        self.assertNear(at(curve, self.found["tuning"]["design_wind_speed_m_per_s"]),
                        self.evaluated(self.design["boresight_rms_mdeg"]), 3e-3)
        marks = {round(mark["y"], 4): mark["x"] for mark in figure["panels"][0]["marks"]}
        for budget in self.found["tuning"]["budgets"]:
            self.assertNear(marks[round(budget["rms_mdeg"], 4)], budget["wind_speed_limit_m_per_s"],
                            1e-5)
            self.assertNear(at(curve, budget["wind_speed_limit_m_per_s"]), budget["rms_mdeg"], 3e-3)

    def test_error_adds_up_to_the_rms(self):
        total = series_of(self.figures["tuned-error-spectrum"], 1)["y"]
        self.assertEqual(total, sorted(total))
        self.assertNear(total[-1], self.design["wind_rms_mdeg"], 1e-3)

    def test_sensitivity_peaks_where_the_verification_says(self):
        figure = self.figures["tuned-sensitivity"]
        for loop in breaks_of(self.design):
            curve = series_of(figure, 0, loop["loop_break"])
            peak = max(curve["y"])
            self.assertLess(peak, loop["sensitivity_peak_1"] * (1 + 1e-5))
            self.assertNear(peak, loop["sensitivity_peak_1"], 2e-3)
            self.assertNear(curve["x"][curve["y"].index(peak)],
                            loop["sensitivity_peak_frequency_Hz"], 0.06)

    def test_nyquist_curves_keep_the_distance_of_their_peaks(self):
        figure = self.figures["tuned-nyquist"]
        for loop in breaks_of(self.design):
            curve = series_of(figure, 0, loop["loop_break"])
            distance = min(math.hypot(1 + x, y) for x, y in zip(curve["x"], curve["y"]))
            self.assertNear(distance, 1 / loop["sensitivity_peak_1"], 2e-3)
        disk = figure["panels"][0]["circles"][-1]
        nearest = min(math.hypot(x - disk["x"], y - disk["y"])
                      for series in figure["panels"][0]["series"]
                      for x, y in zip(series["x"], series["y"]))
        self.assertNear(nearest, disk["radius"], 2e-3)

    def test_crossovers_lie_on_the_loop_gain(self):
        figure = self.figures["tuned-open-loop"]
        marks = [mark for mark in figure["panels"][0]["marks"] if mark["y"] == 0]
        self.assertGreaterEqual(len(marks), 3)
        for mark in marks:
            ends = [around(series, mark["x"]) for series in figure["panels"][0]["series"]]
            self.assertTrue(any(min(y) < 0.1 and max(y) > -0.1 for y in ends), ends)  # dB

    def test_bode_plot_is_marked_with_the_margins_of_the_table(self):
        gain, phase = self.figures["tuned-open-loop"]["panels"]
        for loop in breaks_of(self.design):
            margins = loop["margins"]
            self.assertTrue(any(abs((mark["y"] + 180) % 360 - side) < 0.5
                                for mark in phase["marks"]
                                for side in (margins["phase_margin_deg"],
                                             360 - margins["phase_margin_deg"])),
                            loop["loop_break"])
            self.assertIsNotNone(margins["increasing_gain_margin_dB"])
            self.assertTrue(any(abs(mark["y"] + margins["increasing_gain_margin_dB"]) < 1e-3
                                for mark in gain["marks"]), loop["loop_break"])
            self.assertTrue(any(abs(mark["x"] - loop["sensitivity_peak_frequency_Hz"])
                                < 0.06 * mark["x"] for mark in gain["marks"]))

    def test_sensitivity_over_the_ensemble_reaches_its_members(self):
        figure = self.figures["tuned-ensemble-sensitivity"]
        members = self.found["tuning"]["ensemble"]["members"]
        names = [loop["loop_break"] for loop in self.design["loop_breaks"]]
        self.assertEqual(len(figure["panels"]), len(breaks_of(self.design)))
        for panel in figure["panels"]:
            place = names.index(panel["y"]["label"].removeprefix("|S|, "))
            band = panel["series"][0]
            highest = max(member["sensitivity_peaks_1"][place] for member in members
                          if member["stable"])
            self.assertLess(max(band["y_upper"]), highest * (1 + 1e-4))
            self.assertNear(max(band["y_upper"]), highest, 0.03)
            for low, middle, high in zip(band["y_lower"], band["y"], band["y_upper"]):
                self.assertTrue(low <= middle <= high)

    def test_rms_against_wind_spans_the_ensemble(self):
        band = series_of(self.figures["tuned-rms-against-wind"], 0)
        ensemble = self.found["tuning"]["ensemble"]
        speed = self.found["tuning"]["design_wind_speed_m_per_s"]
        for bound, key in (("y_lower", "min"), ("y_upper", "largest")):
            value = at({"x": band["x"], "y": band[bound]}, speed)
            self.assertNear(value, self.evaluated(ensemble[f"{key}_boresight_rms_mdeg"]), 5e-3)

    def test_error_budget_sums_in_quadrature(self):
        parts, total, apart = self.figures["tuned-error-budget"]["panels"][0]["series"]
        self.assertNear(total["x"][0], math.hypot(*parts["x"]), 1e-5)
        self.assertNear(parts["x"][0], self.design["wind_rms_mdeg"], 1e-5)
        self.assertNear(parts["x"][1], self.design["noise_rms_mdeg"], 1e-5)
        self.assertNear(apart["x"][0], self.found["tuning"]["static_error_mdeg"], 1e-5)

    def test_uncertainty_budget_has_the_contributions_of_the_table(self):
        panels = self.figures["stated-uncertainty"]["panels"]
        methods = self.found["identification"]["methods"]
        self.assertEqual(len(panels), len(methods))
        for panel, method in zip(panels, methods):
            contributions = method["reflected_inertia"]["contributions"]
            self.assertEqual(panel["y"]["categories"], [one["input"] for one in contributions])
            fractions = panel["series"][0]["x"]
            self.assertEqual(fractions, sorted(fractions, reverse=True))
            for x, one in zip(fractions, contributions):
                self.assertNear(x, 100 * one["variance_fraction_1"], 1e-5)

    def test_matching_has_the_numbers_of_its_table(self):
        figure = self.figures["matching"]
        for series, drawn in zip(self.found["matching"], figure["panels"][0]["series"]):
            self.assertEqual(len(series["points"]), len(drawn["x"]))
            for point, x, y in zip(series["points"], drawn["x"], drawn["y"]):
                self.assertNear(y, point["design"]["boresight_rms_mdeg"], 1e-5)
                self.assertAlmostEqual(x, point["flywheel_disks_1"], 4)


class TimeDomain(Near):
    def setUp(self):
        self.found = report("redesign")["time_domain"]
        self.figures = figures_of(report("redesign"))

    def test_limit_cycles_have_their_amplitude(self):
        panels = self.figures["time-domain-limit-cycle"]["panels"]
        self.assertEqual(len(panels), len(self.found["limit_cycles"]))
        for panel, run in zip(panels, self.found["limit_cycles"]):
            values = panel["series"][0]["y"]
            amplitude = 0.5 * (max(values) - min(values))
            self.assertLess(amplitude, run["boresight_amplitude_mdeg"] * (1 + 1e-4))
            self.assertGreater(amplitude, 0.5 * run["boresight_amplitude_mdeg"])

    def test_reversals_reach_their_peak(self):
        boresight, encoder = self.figures["time-domain-reversal"]["panels"]
        for panel, key in ((boresight, "boresight_error_mdeg"), (encoder, "encoder_error_mdeg")):
            largest = max(abs(y) for y in panel["series"][0]["y"])
            self.assertNear(largest, self.found["reversal"][key], 1e-4)

    def test_error_in_wind_is_of_the_size_of_its_rms(self):
        errors = self.figures["time-domain-wind"]["panels"][0]["series"][-1]["y"]
        rms = self.found["wind"]["boresight_rms_mdeg"]
        self.assertGreater(max(abs(y) for y in errors), rms)
        self.assertLess(max(abs(y) for y in errors), 8 * rms)


class Studies(Near):
    def test_structures_are_the_tuned_controllers(self):
        found = report("tune", TUNED)
        figure = figures_of(found)["structures"]
        rms = {round(controller["design"]["boresight_rms_mdeg"], 4) for controller in found["tuned"]["controllers"]}
        bars = [y for series in figure["panels"][0]["series"] if "nonlinear" not in series["name"]
                for y in series["y"]]
        self.assertGreater(len(bars), 2)
        for bar in bars:
            self.assertTrue(any(abs(bar - value) < 2e-4 for value in rms), bar)

    def test_match_has_the_controllers_that_meet_their_constraints(self):
        found = report("match", threads=1)
        figure = figures_of(found)["match-rms"]
        for structure in found["matched"]["series"]:
            drawn = series_of(figure, 0, structure["structure"])
            for controller, y in zip(structure["controllers"], drawn["y"]):
                if y is not None:
                    self.assertNear(y, controller["result"]["boresight_rms_mdeg"], 1e-5)
            best = structure["best"]
            self.assertTrue(any(abs(mark["y"] - best["boresight_rms_mdeg"]) < 1e-5
                                for mark in figure["panels"][0]["marks"]))

    def test_front_and_chances_are_the_decision(self):
        found = report("evaluate")
        figures = figures_of(found)
        costs = {candidate["name"]: candidate["cost_1"]
                 for candidate in found["evaluated"]["candidates"]}
        drawn = series_of(figures["pareto"], 0)
        self.assertTrue(drawn["labels"])
        for label, x in zip(drawn["labels"], drawn["x"]):
            self.assertAlmostEqual(x, costs[label], 3)
        probabilities = series_of(figures["probabilities"], 0)
        self.assertAlmostEqual(sum(probabilities["x"]), 1.0, 4)
        for x, low, high in zip(probabilities["x"], probabilities["x_lower"], probabilities["x_upper"]):
            self.assertTrue(low <= x <= high)
