#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm positive{.minimum = 0.0};
constexpr io::NumberForm above_zero{.above = 0.0, .finite = true};
constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};

constexpr std::array<std::string_view, 3> wind_models{"uniform", "vickery", "coherence"};

// The largest sensitivity allowed where the loop is cut.
struct SensitivityConstraint {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  double peak = 0.0;
};

// A loop tuned at one motor inertia.
struct MatchingPoint {
  MatchingRow row;
  design::Design design;
};

void describe_choice(io::Visitor& v, const InterpretationResult& choice) {
  v.text("name", choice.name, "The choice.");
  v.text("says", choice.says, "What it takes from where.");
  v.number("oil_stiffness", choice.oil_stiffness, {.suffix = "N_m_per_rad"}, "Of the oil spring.",
           {.above = 0.0});
  v.number("reflected_inertia", choice.reflected_inertia, inertia_unit, "At the motor shaft.");
  v.number("motor_to_load_ratio", choice.motor_to_load_ratio, unit::ratio,
           "Motors over load; without meaning where the inertia is below that of the motors.");
  v.text_or_null("impossible_because", choice.impossible,
                 "Why there is no plant; null where there is one.");
  v.numbers_if(
      "speed_limits", choice.speed_limits.has_value(),
      choice.speed_limits.value_or(std::vector<double>{}), unit::metre_per_second,
      "Mean wind speeds up to which this choice's controller meets each budget on its plant, "
      "with fixed gains; null as a whole without a plant or a stable controller, null of a budget "
      "that "
      "is met in all winds looked at.",
      positive);
  v.object("design", choice.design, "Its controller; null where there is no plant.");
}

void describe_point(io::Visitor& v, const MatchingPoint& point) {
  const MatchingRow& row = point.row;
  v.text("label", row.label, "Number of disks, or 'ratio 1'.");
  v.number("flywheel_disks", row.disks, unit::ratio, "On each motor; not whole at ratio 1.",
           {.minimum = 0.0, .finite = true});
  v.number("motor_inertia", row.motor_inertia, inertia_unit, "All motors.", above_zero);
  v.number("reflected_inertia", row.reflected_inertia, inertia_unit, "Motors and load.",
           above_zero);
  v.number("motor_to_load_ratio", row.motor_to_load_ratio, unit::ratio, "Motors over load.",
           positive);
  v.object("design", point.design, "The loop tuned there.");
}

void describe_series(io::Visitor& v, const MatchingSection& section, const MatchingSeries& series) {
  v.text("structure", control::to_string(series.structure), "Loop structure.");
  v.text("friction", friction_text(series), "Which friction.");
  v.number("viscous_friction", series.viscous_friction, {.suffix = "N_m_s_per_rad"},
           "Slope of that friction.", {.finite = true});
  std::vector<MatchingPoint> points;
  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    points.push_back({section.rows[i], series.designs[i]});
  }
  v.list("points", points, "By number of disks.",
         [&](const MatchingPoint& point) { describe_point(v, point); }, {.minimum = 2});
}

void describe_conditions(io::Visitor& v, const TuningSection& section) {
  const plant::GustSpectrum gusts = plant::site_gusts(section.wind_site);
  const double speed = section.design_speed;  // 0 by example, of which there is no variance
  const double intensity =
      v.by_example() ? 0.0 : std::sqrt(plant::gust_variance(gusts, speed)) / speed;
  v.number("design_wind_speed", speed, unit::metre_per_second, "Mean wind speed.", above_zero);
  v.word("wind_model", plant::to_string(section.wind_model), wind_models,
         "Model of the wind torque.");
  v.word("gust_spectrum", plant::to_string(gusts.kind),
         {"davenport", "von_karman", "kaimal", "eurocode"}, "Spectrum of the gusts.");
  v.number("turbulence_intensity", intensity, unit::ratio,
           "Rms of the gusts over the design wind speed.", {.minimum = 0.0, .finite = true});
  v.number("wind_torque_coefficient", section.wind_site.torque_coefficient, unit::ratio,
           "Mean torque over 1/2 rho V^2 A D, from the table at its yaw and elevation if the case "
           "has one.",
           {.finite = true});
}

void describe_goals(io::Visitor& v, const design::Constraints& goals) {
  std::vector<SensitivityConstraint> peaks;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    peaks.push_back({control::loop_breaks.at(b), goals.sensitivity_peak.at(b)});
  }
  v.list("sensitivity_constraints", peaks, "Largest sensitivities allowed.",
         [&](const SensitivityConstraint& one) {
           io::describe_break(v, "loop_break", one.loop_break);
           v.number("sensitivity_peak", one.peak, unit::ratio, "Goal.",
                    {.minimum = 1.0, .finite = true});
         },
         {.minimum = control::loop_breaks.size(), .maximum = control::loop_breaks.size()});
  v.number("control_effort_constraint", goals.control_effort, unit::radian_per_second,
           "Largest control effort allowed.", above_zero);
}

void describe_search(io::Visitor& v, const TuningSection& section) {
  v.list("seeds", section.seeds, "The search from each seed; none of a state space.",
         [&](const TuningSection::SeedResult& one) {
           v.count("seed", one.seed, "The seed.");
           v.number("boresight_rms", one.boresight_rms, unit::millidegree,
                    "Boresight error that the search reached.", positive);
           v.flag("verified", one.verified, "Confirmed by independent code.");
         });
}

void describe_wind_models(io::Visitor& v, const TuningSection& section) {
  v.list("wind_models", section.wind_alternatives, "The same gains by each wind model.",
         [&](const TuningSection::WindAlternative& one) {
           v.word("model", plant::to_string(one.model), wind_models, "Model of the wind torque.");
           v.number("boresight_rms", one.boresight_rms, unit::millidegree, "Boresight error.",
                    positive);
           v.numbers("budget_wind_speed_limits", one.speed_limits, unit::metre_per_second,
                     "Mean wind speeds up to which the budgets are met by this model, in their "
                     "order; null: beyond 60 m/s.",
                     positive);
         });
}

void describe_bands(io::Visitor& v, const TuningSection& section) {
  v.list("bands", section.losses, "Loss in each band.", [&](const TuningSection::BandLoss& loss) {
    v.text("name", loss.band.name, "The band.");
    v.number("frequency", loss.band.frequency, unit::hertz, "Carrier frequency.", above_zero);
    v.number("beamwidth", loss.band.beamwidth, unit::millidegree, "Half-power beamwidth.",
             above_zero);
    v.number("mean_loss_two_axes", loss.mean_loss_db, unit::decibel_as_kept,
             "Mean loss with two equal axes, static error left out, by a parabola that does not "
             "hold beyond 3 dB; texts say > 3 there.",
             positive);
    v.number("static_error_loss", loss.static_error_db, unit::decibel_as_kept,
             "What the static error on this axis would add if no pointing model removed it.",
             positive);
  });
}

void describe_present(io::Visitor& v, const TuningSection& section) {
  v.list("present", section.present,
         "The gains that the antenna runs on now, by the case, on the same plant; if it states "
         "none, the present structure, or that of fewest gains, tuned for this plant.",
         [&](const TuningSection::PresentController& controller) {
           v.text("structure", controller.structure, "Its loop structure.");
           v.flag("stable", controller.design.tuning.status != design::TuningStatus::unstable,
                  "The loop is stable on the plant.");
           v.flag("retuned", controller.retuned, "Tuned for this plant: the case states no gains.");
           v.flag("constraints_met", controller.design.verification.passed,
                  "It meets every constraint.");
           v.number("boresight_rms", controller.design.boresight_rms, unit::millidegree,
                    "Boresight error; null of an unstable loop.", positive);
           v.number("simulated_rms", controller.simulated_rms, unit::millidegree,
                    "Expected on the nonlinear antenna; null if it was "
                    "not simulated.",
                    positive);
         });
  v.flag("is_retuned_present", section.is_retuned_present,
         "The case states no present gains, and the recommended controller is itself what it "
         "would be compared with; present is then empty.");
}

void describe_inputs(io::Visitor& v, const TuningSection& section) {
  constexpr io::KeyUnit as_named{.suffix = "si"};
  v.list("input_effects", section.input_effects,
         "The numbers of the case on which the controller's rms depends most, each moved alone "
         "with fixed gains; the largest effect first.",
         [&](const InputEffect& effect) {
           v.text("key", effect.quantity.key, "Its place in the case file.");
           v.word("basis", to_string(effect.quantity.basis),
                  {"unstated", "measured", "published", "inferred", "assumed"},
                  "What it rests on.");
           v.number("value", effect.quantity.value, as_named,
                    "As the case has it; frequencies in Hz.", {.finite = true});
           v.number(
               "moved_by", effect.moved_by, as_named,
               "To either side: its standard uncertainty, or a tenth of an assumed value "
               "without one. An assumed fraction of wind or boresight without one is moved to its "
               "body's fraction of the inertia, if that is farther than a tenth, and as far to "
               "the other side, but not beyond 0 and 1.",
               above_zero);
           v.flag("uncertainty_unstated", effect.unstated,
                  "The case states no uncertainty, and moved_by is such a guess.");
           v.number("lower_boresight_rms", effect.low_rms, unit::millidegree,
                    "With the number lower; null if unstable.", positive);
           v.number("higher_boresight_rms", effect.high_rms, unit::millidegree,
                    "With the number higher; null if unstable.", positive);
         });
  v.group_if("input_range", !section.input_effects.empty(),
             "Range of the rms over all of these together, in quadrature; null without any.", [&] {
               const auto range =
                   combined_range(section.input_effects, section.design.boresight_rms);
               v.number("lower", range.lower, unit::millidegree, "Lower end.", positive);
               v.number("upper", range.upper, unit::millidegree,
                        "Upper end; null if one of them makes the loop unstable.", positive);
             });
}

void describe_probability(io::Visitor& v, std::string_view key,
                          const std::optional<design::EstimatedNumber>& probability,
                          std::string_view meaning) {
  v.optional_group(key, probability, meaning, [&](const design::EstimatedNumber& found) {
    v.number("value", found.value, unit::ratio, "Fraction of the plants.");
    v.number("lower", found.lower, unit::ratio, "Of the interval.");
    v.number("upper", found.upper, unit::ratio, "Of the interval.");
  });
}

void describe_budgets(io::Visitor& v, const TuningSection& section) {
  v.list(
      "budgets", section.budgets, "Wind speed up to which each budget is met.",
      [&](const BudgetResult& result) {
        v.text("name", result.budget.name, "The budget.");
        v.text("band", result.budget.band, "Its band.");
        v.text("convention", result.budget.convention, "What the loss is taken of.");
        v.number("rms", result.budget.rms, unit::millidegree, "As rms error of one axis.",
                 above_zero);
        v.number("required_wind_speed", result.budget.wind_speed, unit::metre_per_second,
                 "Mean wind speed up to which the case requires it; null if it states none.",
                 above_zero);
        v.number("wind_speed_limit", result.wind_speed_limit, unit::metre_per_second,
                 "Mean wind speed up to which it is met, with fixed gains, limit cycle included.",
                 positive);
        v.count("plants_met", result.plants_met,
                "Plants of the ensemble on which it is met in the wind up to which the case "
                "needs it, supply torque not counted; null without such a wind or an ensemble.");
        describe_probability(
            v, "probability", result.probability,
            "That a plant sampled from the case's ranges, or from what the records leave open, "
            "meets it in the wind up to which the case needs it, or in the design wind if it "
            "states none, with its 95 % interval; null without a stable controller.");
        describe_fraction_of_time(v, section.climate, reached_wind_speed(section, result),
                                  "Fraction of the climate's time up to that speed, or up to the "
                                  "supply's if that is less; null without a climate.");
      });
}

}  // namespace

void describe(io::Visitor& v, const TuningSection& section) {
  v.defined_as("tuning", "The loops tuned for the least boresight rms in wind.");
  describe_conditions(v, section);
  v.word("tuned_for", to_string(section.tuned_for), {"nominal", "robust"},
         "What the recommended controller was tuned for: the case's plant alone, or all of the "
         "ensemble.");
  v.object("design", section.design, "The controller recommended, by tune.");
  v.optional_group("loops", section.loops,
                   "Of a state space: the best loops with gains, with whose structure other "
                   "antennas are tuned; null where the recommended controller has gains itself.",
                   [&](const design::RecommendedDesign::Loops& loops) {
                     v.text("structure", loops.structure, "As --structure takes it.");
                     v.object("design", loops.design, "These loops.");
                     v.number("simulated_rms", loops.simulated_rms, unit::millidegree,
                              "On the nonlinear antenna; null if not simulated.", positive);
                   });
  v.texts("ties", section.ties,
          "Other controllers whose simulated rms, limit cycle included, does not differ by more "
          "than 2 % or than the same winds leave open.");
  v.object("effect", section.effect,
           "Of its simulation, at least that of the linear plant: budgets are evaluated by it.");
  v.number("evaluated_rms", section.effect.rms(section.design.boresight_rms), unit::millidegree,
           "What budgets are compared with in the design wind: boresight rms with that effect; "
           "null if a "
           "run was lost.",
           positive);
  v.count("seeds_within_1_percent", section.seeds_within_1_percent,
          "Seeds whose verified rms is within 1 % of the best.");
  v.number("flexure_rms", section.flexure_rms, unit::millidegree,
           "Rms of flexure beyond the encoder, with the encoder at rest; not a bound.", positive);
  v.number("torque_limited_wind_speed", section.torque_limited_wind_speed, unit::metre_per_second,
           "Mean wind speed whose mean torque takes what friction and offset leave of the "
           "supply's; null if there is none.",
           positive);
  v.number("static_error", section.static_error, unit::millidegree,
           "Boresight error at rest in the mean wind, structural flexure included; not in the rms.",
           positive);
  v.number(
      "static_encoder_error", section.static_encoder_error, unit::millidegree,
      "Encoder error that leakage leaves at rest in the mean wind, without what compensation of "
      "the flexure moves the encoder by; not in the rms.",
      positive);
  v.optional_members(section.wind_mast, [&](const plant::WindMast& mast) {
    v.object("wind_mast", mast, "Where the case names one.");
  });
  describe_goals(v, section.goals);
  describe_search(v, section);
  describe_wind_models(v, section);
  describe_bands(v, section);
  describe_present(v, section);
  v.object("ensemble", section.ensemble,
           "The design's controller with fixed gains on the ensemble members: drawn from what the "
           "records leave open, otherwise the case's ensemble; null without a stable controller.");
  describe_probability(
      v, "probability_all_constraints_met", section.constraints_met,
      "That the loop is stable and within every constraint on a plant sampled from the case's "
      "ranges, or from what the records leave open; null without a stable controller.");
  describe_probability(
      v, "instability", section.instability,
      "Of a redesign from records: probability that the loop is unstable on a sample of the case's "
      "ranges about the identified plant, with its 95 % interval; null without records.");
  v.optional_group(
      "step_overshoot", section.curves,
      "Fraction of a step of the command by which the response exceeds it, continuous, without "
      "command preprocessor and feedforward; null without an ensemble.",
      [&](const design::EnsembleCurves& curves) {
        v.number("position_loop", curves.position_step.overshoot(), unit::ratio,
                 "Encoder after a position step, nominal plant.", positive);
        v.number("position_loop_largest", curves.position_step.largest_overshoot(), unit::ratio,
                 "The largest over the stable plants.", positive);
        const auto of_rate_loop = [&](double overshoot) {
          return curves.rate_step.time.size() > 0 ? std::optional(overshoot) : std::nullopt;
        };
        v.number("rate_loop", of_rate_loop(curves.rate_step.overshoot()), unit::ratio,
                 "Tachometer after a rate step, position loop open, nominal plant; null for a "
                 "state space, which has no rate loop.",
                 positive);
        v.number("rate_loop_largest", of_rate_loop(curves.rate_step.largest_overshoot()),
                 unit::ratio, "The largest over the stable plants.", positive);
      });
  describe_inputs(v, section);
  describe_budgets(v, section);
}

void describe_interpretations(io::Visitor& v,
                              const std::vector<InterpretationResult>& interpretations) {
  v.list("interpretations", interpretations,
         "The loop tuned on what other choices among contradictory numbers make of the plant.",
         [&](const InterpretationResult& choice) { describe_choice(v, choice); }, {.minimum = 1});
}

void describe_matching(io::Visitor& v, const MatchingSection& section) {
  v.list("matching", section.series,
         "The loops tuned again at each number of flywheel disks, by loop structure and friction.",
         [&](const MatchingSeries& series) { describe_series(v, section, series); },
         {.minimum = 1});
}

}  // namespace boresight::app
