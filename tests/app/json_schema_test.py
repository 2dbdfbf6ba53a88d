"""Holds the JSON reports of every command against docs/report.schema.json and against what they
must mean.

Run by reports_test.py.
"""

import json
import math
import re
import subprocess
import unittest

import jsonschema

from report_runs import (BIG, PROGRAM, RECORDED, RECORDS, SECTIONS, SMALL, SOURCE, TUNED,
                         every_report, report, run)

SCHEMA = json.loads((SOURCE / "docs/report.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

# A number's key ends in one of these; only whole counts have none.
UNITS = ("1", "kg_m2", "Pa", "N_m", "N_m_per_rad", "N_m_s_per_rad", "Hz", "s", "per_s", "rad_per_s",
         "rad_per_s_V", "rad_per_s_N_m", "rad_per_N_m", "m_per_s", "deg", "mdeg", "dB", "si")
COUNTS = {"seed", "samples", "degrees_of_freedom", "starts", "starts_at_optimum", "starts_with_limit_cycle", "evaluations",
          "seeds_within_1_percent", "checked_numbers", "bytes", "rows", "first_sample", "samples", "steps",
          "events", "cvodes_steps", "counted", "outliers", "iterations", "rank", "varied", "motor", "harmonic",
          "ensemble_members", "records", "rounds", "warm_starts", "even_stretches", "after_grid_point", "stable", "stable_members", "within_constraints", "winds", "full_order"}

# Of a state space, whose signals' units stand beside it (docs/benchmark-protocol.md).
MATRICES = {"A", "B", "C", "D", "sample_time"}


def numbers(value, key=""):
    """Numbers with their keys; not those of figures, whose axes state the units."""
    if isinstance(value, dict):
        for name, inner in value.items():
            if name != "figures" or not isinstance(inner, list):
                yield from numbers(inner, name)
    elif isinstance(value, list):
        for inner in value:
            yield from numbers(inner, key)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield key, value


def designs(value):
    if isinstance(value, dict):
        if "gains" in value:
            yield value
        for inner in value.values():
            yield from designs(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from designs(inner)


class Schema(unittest.TestCase):
    def test_is_a_schema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_allows_no_key_it_does_not_describe(self):
        def walk(node):
            if isinstance(node, dict):
                if node.get("type") == "object":
                    self.assertIs(node.get("additionalProperties"), False, node)
                    for key, inner in node["properties"].items():
                        self.assertTrue({"description", "const", "$ref"} & inner.keys(), key)
                for inner in node.values():
                    walk(inner)
            elif isinstance(node, list):
                for inner in node:
                    walk(inner)

        walk(SCHEMA)

    def test_fits_every_report(self):
        for command, case, found in every_report():
            with self.subTest(command=command, case=case):
                errors = [f"{list(e.absolute_path)}: {e.message[:200]}"
                          for e in VALIDATOR.iter_errors(found)]
                self.assertEqual(errors, [])

    def test_notices_what_does_not_fit(self):
        def check(edit):
            spoilt = report("redesign")
            edit(spoilt)
            self.assertFalse(VALIDATOR.is_valid(spoilt))

        check(lambda r: r.update(extra=1))
        check(lambda r: r["tuning"]["design"].update(extra_1=1.0))
        check(lambda r: r["tuning"]["design"].pop("boresight_rms_mdeg"))
        check(lambda r: r["tuning"]["design"].update(boresight_rms_mdeg="0.5"))
        check(lambda r: r.pop("tuning"))
        check(lambda r: r.update(tuned=report("tune", TUNED)["tuned"]))
        check(lambda r: r.update(command="guess"))

    def test_asks_for_no_section_of_interrupted_work(self):
        stopped = report("redesign")
        for section in ("tuning", "interpretations", "matching"):
            del stopped[section]
        self.assertFalse(VALIDATOR.is_valid(stopped))
        stopped["interrupted"] = True
        self.assertTrue(VALIDATOR.is_valid(stopped))


class Figures(unittest.TestCase):
    def test_stand_under_headings_of_the_text_and_are_whole(self):
        for command, case, found in every_report():
            text = run(command, case, *((1,) if command == "match" else ()))[1].splitlines()
            ids = [figure["id"] for figure in found.get("figures", ())]
            self.assertEqual(len(ids), len(set(ids)))
            for figure in found.get("figures", ()):
                with self.subTest(command=command, case=case, figure=figure["id"]):
                    self.assertIn(figure["section"], text)
                    self.assertTrue(figure["title"] and figure["caption"] and figure["panels"])
                    for panel in figure["panels"]:
                        self.assertTrue(panel["series"])
                        for series in panel["series"]:
                            lists = [series[key] for key in ("x", "y", "x_lower", "x_upper",
                                                             "y_lower", "y_upper", "labels")
                                     if key in series]
                            self.assertEqual(len({len(one) for one in lists}), 1)

    def test_show_what_the_records_say(self):
        figures = {figure["id"]: figure for figure in report("identify", RECORDED)["figures"]}
        self.assertTrue({"campaign-inertia", "campaign-ratio", "campaign-friction",
                         "torque-spectrum-fast-ramp", "ringing-slosh", "step-ring",
                         "campaign-hold-out"} <= figures.keys())
        methods = report("identify", RECORDED)["campaign"]["methods"]
        rows = figures["campaign-inertia"]["panels"][0]
        self.assertEqual(len(rows["y"]["categories"]), 1 + len(methods))
        shown = [x for series in rows["series"] for x in series["x"] if x is not None]
        for method in methods:
            if method["inertia"]["value_si"] <= 0:
                continue  # of a campaign that hardly allows the method
            self.assertTrue(any(math.isclose(x, method["inertia"]["value_si"], rel_tol=1e-5)
                                for x in shown), method["name"])


class Numbers(unittest.TestCase):
    def test_carry_their_unit_in_the_key(self):
        suffix = re.compile(rf".+_({'|'.join(UNITS)})")
        for command, case, found in every_report():
            for key, value in numbers(found):
                with self.subTest(command=command, case=case, key=key):
                    self.assertTrue(math.isfinite(value))
                    if key in MATRICES:
                        continue
                    if key in COUNTS:
                        self.assertIsInstance(value, int)
                    else:
                        self.assertRegex(key, suffix)

    def test_do_not_depend_on_threads(self):
        one, two = (run("tune", TUNED, threads)[0] for threads in (1, 2))
        # The case stands in another temporary folder each time.
        case = rb'"path": "[^"]*"'
        self.assertEqual(re.sub(case, b"", one), re.sub(case, b"", two))
        self.assertEqual(run("match", BIG, 1)[0], run("match", BIG, 2)[0])

    def test_of_a_section_are_the_same_alone_and_in_the_whole(self):
        whole = report("redesign")
        for command, section in SECTIONS.items():
            with self.subTest(section=section):
                alone = report(command)
                self.assertEqual(alone[section], whole[section])

    def test_agree_with_the_text(self):
        found, text = report("redesign"), run("redesign", BIG)[1]
        design, plant = found["tuning"]["design"], found["plant"]
        self.assertIn(f"Rms {design['boresight_rms_mdeg']:.4f} mdeg", text)
        self.assertRegex(text, rf"reflected inertia +{plant['reflected_inertia_kg_m2']:.6g} +kg\.m2")
        self.assertRegex(text, rf"gear ratio +{plant['gear_ratio_1']:.6g} +1\n")
        mean = found["identification"]["combined"]
        self.assertTrue(mean["contradictory"])
        self.assertIn(f"would be {mean['reflected_inertia_kg_m2']:.3f}", " ".join(text.split()))
        for budget in found["tuning"]["budgets"]:
            limit, probability = budget["wind_speed_limit_m_per_s"], budget["probability"]
            self.assertIsNotNone(re.search(
                rf"{re.escape(budget['name'])} +{budget['band']} .* {limit:.2f} +{3.6 * limit:.1f} +{probability['value_1']:.3f} "
                rf"\({probability['lower_1']:.3f} to {probability['upper_1']:.3f}\)\n", text))
        members = found["tuning"]["ensemble"]
        met = found["tuning"]["probability_all_constraints_met"]
        self.assertIn(f"Constraints met: {members['within_constraints']} of {len(members['members'])} ensemble members; "
                      f"sampled plants with probability {met['value_1']:.3f} ({met['lower_1']:.3f} to {met['upper_1']:.3f}).",
                      " ".join(text.split()))
        for assumed in found["assumed_inputs"]:
            self.assertRegex(text, rf"{re.escape(assumed['key'])} +{re.escape(assumed['value'])} ")

    def test_list_the_assumptions_that_their_numbers_rest_on(self):
        for found in (report("redesign"), report("tune", TUNED), report("model")):
            keys = [assumed["key"] for assumed in found["assumed_inputs"]]
            simulated = found.get("time_domain") is not None
            with self.subTest(command=found["command"]):
                self.assertEqual(found["command"] != "model", simulated)
                self.assertEqual("simulation.bristle_stiffness" in keys, simulated)
                self.assertEqual("simulation.backlash" in keys, simulated)
                self.assertNotIn("simulation.rate_loop_gain", keys)
                self.assertFalse([key for key in keys if key.startswith("recorder.")])

    def test_go_to_standard_output_alone_on_request(self):
        shown = subprocess.run([PROGRAM, "model", f"cases/{BIG}/case.toml", "--json", "-"],
                               cwd=SOURCE, capture_output=True, check=True)
        self.assertEqual(shown.stdout, run("model", BIG)[0])
        self.assertEqual(shown.stderr, b"")


class Campaign(unittest.TestCase):
    def setUp(self):
        self.found = report("identify", RECORDED)["campaign"]

    def test_names_every_record_and_what_became_of_it(self):
        self.assertEqual([record["name"] for record in self.found["records"]], list(RECORDS))
        for record in self.found["records"]:
            self.assertIsNone(record["refused_because"])
            self.assertGreater(record["rows"], 1000)
            signals = [source["signal"] for source in record["sources"]]
            self.assertEqual(len(signals), len(set(signals)))
            self.assertIn("tachometer", signals)

    def test_sets_every_method_beside_the_reconciled_inertia(self):
        quantities = {q["name"]: q for q in self.found["combined"]["quantities"]}
        inertia = quantities["inertia"]["posterior"]
        self.assertGreater(len(self.found["methods"]), 5)
        for method in self.found["methods"]:
            own, difference = method["inertia"], method["difference"]
            self.assertLess(own["lower_95_si"], own["value_si"])
            apart = own["value_si"] - inertia["value_si"]
            self.assertAlmostEqual(difference["relative_1"], apart / inertia["value_si"])
            self.assertAlmostEqual(
                difference["normalised_1"],
                apart / math.hypot(own["standard_uncertainty_si"],
                                   inertia["standard_uncertainty_si"]))
            self.assertTrue(method["assumes"])
            self.assertTrue(method["why"])
        correlation = self.found["combined"]["correlation_1"]
        self.assertEqual(len(correlation), len(quantities))
        for i, row in enumerate(correlation):
            self.assertEqual(row[i], 1)
            self.assertEqual(row, [other[i] for other in correlation])

    def test_lists_only_contradictions_beyond_two_sigmas_and_ranks_tests(self):
        sigmas = [abs(one["normalised_1"]) for one in self.found["contradictions"]]
        self.assertEqual(sigmas, sorted(sigmas, reverse=True))
        self.assertTrue(all(sigma > 2 for sigma in sigmas))
        self.assertEqual([one["quantity"] for one in self.found["advice"]],
                         ["inertia", "oil stiffness", "leakage rate", "Coulomb level"])
        for one in self.found["advice"]:
            left = [test["interval_remaining_1"] for test in one["tests"]]
            self.assertEqual(left, sorted(left))
            self.assertTrue(all(0 < fraction <= 1 + 1e-9 for fraction in left))

    def test_gives_plots_whose_series_belong_together(self):
        plots = self.found["plots"]
        friction = plots["friction"]
        count = len(friction["rate_rad_per_s"])
        for key in ("combined_N_m", "combined_lower_95_N_m", "combined_upper_95_N_m"):
            self.assertEqual(len(friction[key]), count)
        for lower, value, upper in zip(friction["combined_lower_95_N_m"],
                                       friction["combined_N_m"],
                                       friction["combined_upper_95_N_m"]):
            self.assertTrue(lower < value < upper)
        self.assertEqual(len(plots["torque_spectra"]), 1)
        spectrum = plots["torque_spectra"][0]
        self.assertEqual(len(spectrum["frequency_Hz"]), len(spectrum["amplitude_N_m"]))
        self.assertTrue(any(peak["harmonic"] > 0 for peak in spectrum["peaks"]))
        self.assertEqual(len(plots["line_ringing"][0]["ports"]), 4)
        for port in plots["line_ringing"][0]["ports"]:
            self.assertEqual(len(port["pressure_Pa"]), len(port["fitted_Pa"]))
            self.assertEqual(len(port["frequency_Hz"]), len(port["amplitude_Pa"]))
            self.assertGreater(len(port["frequency_Hz"]), 10)
        rings = plots["step_rings"]
        self.assertGreater(len(rings["rings"]), 3)
        self.assertEqual(len(rings["time_s"]), len(rings["fitted_torque_N_m"]))
        held = plots["hold_out"]
        self.assertEqual(len(held["torque_N_m"]), len(held["simulated_torque_N_m"]))
        for response in plots["torque_over_rate"]:
            self.assertEqual(len(response["frequency_Hz"]), len(response["measured_real_N_m_s_per_rad"]))

    def test_foretells_a_record_that_was_not_fitted(self):
        held = self.found["hold_out"]
        self.assertEqual(held["record"], "valve_steps")
        self.assertTrue(0 < held["rate_error_1"] < 0.5)
        self.assertTrue(0 < held["torque_error_1"] < 0.5)

    def test_agrees_with_the_text(self):
        text = run("identify", RECORDED)[1]
        for q in self.found["combined"]["quantities"]:
            scale = {"Pa": 1e-6, "s": 1e3}.get(q["posterior"]["unit"], 1)
            self.assertIn(f"{q['posterior']['value_si'] * scale:.4g}", text)
        for method in self.found["methods"]:
            self.assertIn(method["name"], text)


class Tune(unittest.TestCase):
    def setUp(self):
        self.found = report("tune", TUNED)["tuned"]
        self.controllers = {(one["structure"], one["tuned_for"]): one
                            for one in self.found["controllers"]}

    def test_has_every_controller(self):
        self.assertEqual(self.found["structures"], ["PI", "PI-0"])
        self.assertEqual(list(self.controllers), [
            ("FULL+N+C", "present"), ("PI with a second lag", "present"), ("PI", "nominal"),
            ("PI", "robust"), ("PI-0", "nominal"), ("PI-0", "robust")])
        self.assertEqual((self.found["not_run"], self.found["shortfalls"]), ([], []))

    def test_claims_only_controllers_that_keep_their_goals(self):
        for (_, purpose), controller in self.controllers.items():
            if purpose == "present" or not controller["constraints_met"]:
                continue
            self.assertTrue(controller["design"]["verified"])
            for cut, goal in zip(controller["design"]["loop_breaks"], self.found["constraints"]["loop_breaks"]):
                self.assertLessEqual(cut["sensitivity_peak_1"],
                                     goal["sensitivity_peak_1"] * (1 + 1e-6))
            for member in controller["ensemble"]["members"] if purpose == "robust" else ():
                self.assertTrue(member["stable"])
                self.assertLessEqual(member["worst_constraint_1"], 1 + 1e-5)
        self.assertTrue(self.controllers["PI", "nominal"]["constraints_met"])
        # More gains and fewer plants can only help.
        rms = {key: controller["boresight_rms_mdeg"] for key, controller in self.controllers.items()}
        self.assertLessEqual(rms["PI", "nominal"], rms["PI-0", "nominal"] * 1.001)
        self.assertLessEqual(rms["PI", "nominal"], rms["PI", "robust"] * 1.001)

    def test_reckons_losses_and_limits_from_the_rms(self):
        for controller in self.controllers.values():
            if controller["boresight_rms_mdeg"] is None:
                continue
            for band, result in zip(self.found["bands"], controller["bands"]):
                for rms, loss in (("boresight_rms_mdeg", "mean_loss_two_axes_dB"),
                                  ("climate_boresight_rms_mdeg", "climate_mean_loss_two_axes_dB")):
                    self.assertAlmostEqual(result[loss],
                                           24 * (controller[rms] / band["beamwidth_mdeg"]) ** 2)
            for budget, result in zip(self.found["budgets"], controller["budgets"]):
                limit = result["wind_speed_limit_m_per_s"] or math.inf
                self.assertEqual(limit >= controller["design_wind_speed_m_per_s"],
                                 controller["boresight_rms_mdeg"] <= budget["rms_mdeg"])

    def test_gives_gains_as_the_case_writes_them(self):
        controller = self.controllers["PI with a second lag", "present"]
        self.assertEqual([(gain["symbol"], gain["value"]) for gain in controller["gains_as_written"]],
                         [("kr", "0.2"), ("wi", "0.127 Hz"), ("wp", "0.95 Hz"), ("wp2", "40 Hz"),
                          ("kp", "0.2 1/s"), ("wip", "0.02 rad/s")])

    def test_agrees_with_the_text(self):
        text = run("tune", TUNED)[1]
        for (structure, purpose), controller in self.controllers.items():
            rms = controller["boresight_rms_mdeg"]
            shown = "-" if rms is None else f"{rms:.4f}"
            self.assertRegex(text, rf"{re.escape(structure)} +{purpose} +10 +{re.escape(shown)} ")
            for gain in controller["gains_as_written"]:
                self.assertIn(gain["value"], text)


class Redesign(unittest.TestCase):
    def test_tells_inertia_and_ratio_consistently(self):
        for case in (BIG, SMALL):
            found = report("identify", case)["identification"]
            plant = report("model", case)["plant"]
            side = plant["motor_side_inertia_kg_m2"]
            motors = plant["reflected_inertia_kg_m2"] / (1 + 1 / plant["motor_to_load_ratio_1"])
            for method in found["methods"]:
                inertia = method["reflected_inertia"]
                value = inertia["value_kg_m2"]
                self.assertLess(inertia["lower_95_kg_m2"], value)
                self.assertLess(value, inertia["upper_95_kg_m2"])
                self.assertAlmostEqual(method["antenna_remainder"]["value_kg_m2"], value - side)
                self.assertAlmostEqual(method["motor_to_load_ratio"]["value_1"],
                                       motors / (value - motors), delta=1e-6)
                fractions = [c["variance_fraction_1"] for c in inertia["contributions"]]
                # Inputs below 1 % of the variance are left out.
                self.assertTrue(0.9 < sum(fractions) < 1 + 1e-9)
                self.assertEqual(fractions, sorted(fractions, reverse=True))
            self.assertAlmostEqual(found["methods"][0]["reflected_inertia"]["value_kg_m2"],
                                   plant["reflected_inertia_kg_m2"])

    def test_claims_only_designs_that_keep_their_goals(self):
        for found in (report("redesign"),):
            goals = [goal["sensitivity_peak_1"] for goal in found["tuning"]["sensitivity_constraints"]]
            effort = found["tuning"]["control_effort_constraint_rad_per_s"]
            for design in designs(found):
                self.assertTrue(design["feasible"])
                self.assertTrue(design["verified"])
                if design["gains"]:  # a state space has none
                    self.assertEqual("rate_lag_corner_rad_per_s" in design["gains"],
                                     design["structure"] != "PI without lag")
                for cut, goal in zip(design["loop_breaks"], goals):
                    self.assertLessEqual(cut["sensitivity_peak_1"], goal * (1 + 1e-6))
                    # Ms bounds the phase margin from below.
                    self.assertGreaterEqual(
                        cut["margins"]["phase_margin_deg"],
                        math.degrees(2 * math.asin(0.5 / cut["sensitivity_peak_1"])) - 1e-3)
                self.assertLessEqual(design["control_effort_rad_per_s"], effort * (1 + 1e-6))
                self.assertLess(design["verification"]["closed_loop_abscissa_per_s"], 0)
                self.assertAlmostEqual(
                    math.hypot(design["wind_rms_mdeg"], design["noise_rms_mdeg"]),
                    design["boresight_rms_mdeg"], delta=1e-9)

    def test_is_confirmed_by_a_second_integrator(self):
        for found in (report("redesign")["time_domain"], report("tune", TUNED)["time_domain"]):
            integrators = found["integrators"]
            self.assertTrue(integrators["agree"])
            # The encoder's steps amplify rounding in a loop of high gain.
            without = integrators["ratio_without_quantisation_1"]
            self.assertLess(integrators["ratio_1"] if without is None else without, 1e-4)

    def test_shows_the_best_loops_beside_a_state_space(self):
        tuning = report("redesign")["tuning"]
        self.assertTrue(tuning["design"]["structure"].startswith("state space"))
        loops = tuning["loops"]
        self.assertTrue(loops["design"]["gains"])
        self.assertLess(tuning["evaluated_rms_mdeg"], 0.98 * loops["simulated_rms_mdeg"])

    def test_compares_the_design_with_other_winds_and_budgets(self):
        tuning = report("redesign")["tuning"]
        best = tuning["design"]["boresight_rms_mdeg"]
        held = {model["model"]: model["boresight_rms_mdeg"] for model in tuning["wind_models"]}
        self.assertAlmostEqual(held[tuning["wind_model"]], best, delta=1e-6)
        self.assertGreater(tuning["flexure_rms_mdeg"], 0.0)
        for budget in tuning["budgets"]:
            met = budget["wind_speed_limit_m_per_s"] >= tuning["design_wind_speed_m_per_s"]
            self.assertEqual(met, best <= budget["rms_mdeg"], budget["name"])

    def test_says_of_each_choice_what_it_would_do_or_why_not(self):
        found = report("redesign")
        choices = found["interpretations"]
        self.assertEqual(choices[0]["name"], "reference")
        for choice in choices:
            self.assertNotEqual(choice["design"] is None, choice["impossible_because"] is None)
        reference = choices[0]["design"]["boresight_rms_mdeg"]
        # Of the same structure, tuned for this plant alone.
        self.assertLess(reference, 1.0001 * found["tuning"]["loops"]["design"]["boresight_rms_mdeg"])

    def test_matches_over_all_disks_and_at_ratio_one(self):
        matching = report("redesign")["matching"]
        self.assertEqual(len({(s["structure"], s["friction"]) for s in matching}), 2)
        for series in matching:
            points = series["points"]
            disks = [point["flywheel_disks_1"] for point in points]
            self.assertEqual(disks, sorted(disks))
            self.assertEqual(disks[0], 0)
            self.assertIn(24, disks)
            at_one = [p for p in points if p["label"] == "ratio 1"]
            self.assertEqual(len(at_one), 1)
            self.assertAlmostEqual(at_one[0]["motor_to_load_ratio_1"], 1.0)
            for point in points:
                self.assertEqual(point["design"]["structure"], series["structure"])
                load = point["reflected_inertia_kg_m2"] - point["motor_inertia_kg_m2"]
                self.assertAlmostEqual(point["motor_inertia_kg_m2"] / load,
                                       point["motor_to_load_ratio_1"])
