#include <array>
#include <string>
#include <vector>

#include <boresight/app/report/match_report.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/matching_verdict.hpp>
#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/io/description/what_if_description.hpp>
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm known{.finite = true};
constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};
constexpr io::KeyUnit slope_unit{.suffix = "N_m_s_per_rad"};

void describe_range(io::Visitor& v, std::string_view key, const FlatRange& range,
                    std::string_view meaning) {
  v.group(key, meaning, [&] {
    v.number("lowest_disks", range.lowest, unit::ratio, "From.");
    v.number("highest_disks", range.highest, unit::ratio, "To.");
  });
}

void describe_point(io::Visitor& v, const MatchPoint& point) {
  v.number("flywheel_disks", point.disks, unit::ratio, "On each motor.", known);
  v.text_or_null("label", label_of(point), "ratio 1, as built.");
  v.number("motor_inertia", point.motor_inertia, inertia_unit, "All motors.", known);
  v.number("motor_to_load_ratio", point.motor_to_load_ratio, unit::ratio,
           "Motors over gear train and antenna.", known);
  v.number("reflected_inertia", point.reflected_inertia, inertia_unit, "All, at the motor shaft.",
           known);
  v.number("hydraulic_frequency", point.hydraulic.frequency, unit::hertz,
           "Of the lowest mode that moves the oil.", known);
  v.number("hydraulic_damping_ratio", point.hydraulic.damping_ratio, unit::ratio, "Of that mode.",
           known);
  v.object("oil_mode", point.oil_mode, "The mode of the largest oil fraction.");
  v.number("acceleration", point.acceleration,
           {.suffix = "mdeg_per_s2", .divisor = unit::millidegree.divisor},
           "At the sky, at the slew rate: half of what the torque left beyond the valve's drop and "
           "friction gives; of cases without [simulation] all that the supply's torque leaves "
           "beyond friction.",
           known);
  v.number("slew_time", point.slew_time, unit::second, "For slew_distance; null: never.");
  v.number("rule_damping_ratio", point.two_mass_damping, unit::ratio, "1/2 sqrt(J_L/J_m).", known);
  v.number("acceleration_of_best_ratio", point.acceleration_of_best_ratio, unit::ratio,
           "Acceleration over the most at any gear ratio.", known);
}

void describe_time(io::Visitor& v, const MatchTimeDomain& run) {
  v.object("expected_rms", run.expected,
           "In wind; null of one not shown free of limit cycles beyond the allowed amplitude.");
  v.number("ensemble_rms", run.member_rms, unit::millidegree,
           "Root of the mean square over the ensemble with these motors, linear; null where "
           "expected_rms is.");
  v.list(
      "limit_cycles", run.limit_cycles, "At rest, then at the tracking rate.",
      [&](const design::LimitCycleResult& one) { describe(v, one, io::LimitCycleDetail::study); });
  v.optional_group("reversal", run.reversal, "A slow triangle of the tracking rate.",
                   [&](const design::ReversalResult& reversal) {
                     io::describe_status(v, reversal.status);
                     v.number("encoder_error", reversal.encoder_error, unit::millidegree,
                              "Largest after a reversal.");
                     v.number("boresight_error", reversal.boresight_error, unit::millidegree,
                              "Boresight error, about its mean.");
                     v.number("encoder_error_without_friction",
                              reversal.encoder_error_without_friction, unit::millidegree,
                              "What a linear loop has too.");
                   });
}

// One controller of a series at one point.
struct PointController {
  design::MatchedController controller;
  MatchValue value;
};

// A gain of a controller.
struct ControllerGain {
  std::string name, symbol, unit;
  double value = 0.0;
};

void describe_gains(io::Visitor& v, const control::Controller& controller) {
  std::vector<ControllerGain> gains;
  for (std::size_t k = 0; k < controller.gains.size(); ++k) {
    const auto& gain = control::gain_descriptions(controller.structure).at(k);
    gains.push_back({gain.name, gain.symbol, gain.unit, controller.gains[k]});
  }
  v.list("gains", gains, "Of the controller.", [&](const ControllerGain& gain) {
    v.text("name", gain.name, "Its name.");
    v.text("symbol", gain.symbol, "Its symbol.");
    v.text("unit", gain.unit, "Of the value.");
    v.number("value", gain.value, {.suffix = "si"}, "Value.", known);
  });
}

void describe_result(io::Visitor& v, const PointController& one) {
  const design::MatchedController& controller = one.controller;
  const MatchValue& value = one.value;
  std::vector<MatchMargins> margins;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    margins.push_back({control::loop_breaks.at(b), value.margins.at(b)});
  }
  v.number("boresight_rms", value.boresight_rms, unit::millidegree, "At the sky, one axis.");
  v.number("wind_rms", value.wind_rms, unit::millidegree, "By wind.");
  v.number("noise_rms", value.noise_rms, unit::millidegree, "By sensor noise.");
  v.number("worst_constraint", controller.worst_constraint, unit::ratio,
           "Largest quantity over limit, over all plants.");
  v.number("control_effort", value.control_effort, unit::radian_per_second,
           "Rms of the valve demand by noise.");
  v.number("gust_demand", value.gust_demand, unit::radian_per_second,
           "Valve demand: mean wind and crest factor times gusts.");
  v.number("gust_torque", value.gust_torque, unit::newton_metre, "Motor torque, the same.");
  v.number("bandwidth", value.bandwidth, unit::hertz,
           "Lowest frequency at which the position loop's |S| reaches 0.71.");
  v.number(
      "acceleration_error", value.acceleration_error, {.suffix = "s2"},
      "Error per constant acceleration that is not fed forward, at the lowest frequency of the "
      "analysis: steady with a position integral, otherwise still growing.");
  v.list("margins", margins, "At each loop break.");
  describe_gains(v, controller.controller);
  v.list("active_constraints", controller.active_constraints,
         "Goals met with less than 1e-4 to spare.", [&](const design::ActiveConstraint& goal) {
           v.text("constraint", design::describe(goal.goal), "Which, and at which frequency.");
           v.text_or_null("member", goal.member, "On which plant; null: the case's.");
         });
  v.texts("gains_at_bound", controller.gains_at_bound, "Names.");
  v.texts("active_scenarios", controller.active_scenarios, "Members that the search had to carry.");
  v.flag("verified", value.verification.passed, "Confirmed apart from the tuner.");
  v.text_or_null("verification_failure", value.verification.failure, "Why not.");
  v.optional_group("time_domain", value.time_domain,
                   "On the nonlinear antenna in still air; null where it was not run.",
                   [&](const MatchTimeDomain& run) { describe_time(v, run); });
}

void describe_controller(io::Visitor& v, const PointController& one) {
  static constexpr std::array<std::string_view, 3> status{"optimal", "infeasible", "unstable"};
  const design::MatchedController& controller = one.controller;
  v.word("status",
         controller.searched ? status.at(static_cast<std::size_t>(controller.status)) : "not run",
         {"optimal", "infeasible", "unstable", "not run"}, "What the tuning found.");
  v.count("starts", controller.starts, "Random starts.");
  v.count("starts_at_optimum", controller.starts_at_optimum,
          "That ended within 1 % of the best controller.");
  v.count("warm_starts", controller.warm_starts,
          "From neighbours and structures that this one extends.");
  v.group_if("result", controller.status != design::TuningStatus::unstable,
             "The controller on the case's plant; null without a stable one.",
             [&] { describe_result(v, one); });
}

void describe_smoothness(io::Visitor& v, const design::CurveSmoothness& smooth) {
  v.numbers("third_differences", smooth.third_differences, unit::ratio,
            "Of ln rms along the evenly spaced points.");
  v.list("kinks", smooth.kinks, "Where the active constraints change.",
         [&](const design::CurveKink& kink) {
           v.count("after_grid_point", kink.after,
                   "Number of the evenly spaced point before it, from 0.");
           v.text("change", kink.change, "What changes.");
         });
  v.count("even_stretches", smooth.even_stretches, "Stretches of four points without a kink.");
  v.number("largest_third_difference", smooth.largest_even, unit::ratio,
           "Over these: to be below three tolerances.", known);
  v.number("largest_third_difference_at_kinks", smooth.largest_at_kinks, unit::ratio,
           "Over the others.", known);
}

void describe_series(io::Visitor& v, const MatchSection& section, const MatchSeries& series) {
  v.text("structure", series.name, "As --structure takes it.");
  v.text("description", series.curve.structure.name(), "In words.");
  v.optional_group("best", series.best, "The least rms; null if no controller holds its goals.",
                   [&](std::size_t best) {
                     const bool there = best < section.points.size();
                     const MatchPoint point = there ? section.points[best] : MatchPoint{};
                     v.number("flywheel_disks", point.disks, unit::ratio, "On each motor.", known);
                     v.number("motor_to_load_ratio", point.motor_to_load_ratio, unit::ratio, "R.",
                              known);
                     v.number("boresight_rms", there ? series.values[best].boresight_rms : 0.0,
                              unit::millidegree, "There.", known);
                     v.flag("at_end_of_range", series.best_at_end, "It may be less beyond.");
                     describe_range(v, "within_1_percent", series.within_1_percent,
                                    "Disks within 1 % of the least rms.");
                     describe_range(v, "within_5_percent", series.within_5_percent, "Within 5 %.");
                   });
  describe_smoothness(v, series.smoothness);
  std::vector<PointController> controllers;
  if (!v.by_example()) {
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      controllers.push_back({series.curve.controllers[i], series.values[i]});
    }
  }
  v.list("controllers", controllers, "In the order of points.",
         [&](const PointController& one) { describe_controller(v, one); });
}

void describe_ranked(io::Visitor& v, const MatchSection& section, const design::RankedMotors& one) {
  const bool there = one.point < section.points.size() && one.series < section.series.size();
  v.number("flywheel_disks", there ? section.points[one.point].disks : 0.0, unit::ratio,
           "On each motor.", known);
  v.text("structure", there ? section.series[one.series].name : "", "Of its controller.");
  v.number("compared_rms", one.compared_rms, unit::millidegree,
           "ensemble_rms as simulated, limit cycle in quadrature; null if a plant is unstable.");
  v.flag("tied", one.tied, "With the least, within 2 % or what the same winds leave open.");
}

void describe_variants(io::Visitor& v, const MatchVariants& variants) {
  v.text("structure", variants.structure, "Which.");
  v.numbers("flywheel_disks", variants.disks, unit::ratio, "Where.", known);
  v.list("variants", variants.variants, "The first is the case's plant.",
         [&](const MatchVariant& variant) {
           v.text("name", name_of(variant), "What is not as the case has it.");
           v.numbers("boresight_rms", variant.rms, unit::millidegree, "At these disks.");
           v.number("best_disks",
                    variant.best ? std::optional(variants.disks[*variant.best]) : std::nullopt,
                    unit::ratio, "Of the least rms.");
           describe_range(v, "within_5_percent", variant.within_5_percent, "Within 5 % of it.");
         });
}

void describe_threshold(io::Visitor& v, const FrictionThreshold& one) {
  v.text("structure", one.structure, "Which.");
  v.number("spread", one.spread, unit::ratio,
           "Between best and worst disks, below which it does not matter.", known);
  v.number("friction_slope", one.slope, slope_unit, "Null: none up to the next.");
  v.number("searched_to", one.searched_to, slope_unit, "Largest slope tried.", known);
  v.number("spread_at_linear_plant", one.spread_at_nominal, unit::ratio,
           "With the linear plant's slope.");
  v.number("spread_at_tracking_rate", one.spread_at_tracking, unit::ratio,
           "With the curve's at the tracking rate.");
}

// What following a rule costs one structure.
struct RuleCost {
  std::string structure;
  double cost = 0.0;
};

void describe_rule(io::Visitor& v, const MatchSection& section, const RuleVerdict& rule) {
  std::vector<RuleCost> costs;
  for (std::size_t s = 0; s < rule.cost.size(); ++s) {
    costs.push_back({section.series[s].name, rule.cost[s]});
  }
  v.text("rule", text_of(rule.rule), "In words.");
  v.number("motor_to_load_ratio", rule.motor_to_load_ratio, unit::ratio, "R that it asks for.",
           known);
  v.number("flywheel_disks", rule.disks, unit::ratio, "Null: less inertia than the bare motors.");
  v.list("costs", costs, "What following it costs.", [&](const RuleCost& one) {
    v.text("structure", one.structure, "Which.");
    v.number("rms_over_min", one.cost, unit::ratio, "Less 1.");
  });
}

void describe_conditions(io::Visitor& v, const MatchSection& section) {
  v.text("wind_model", plant::to_string(section.wind_model), "Model of the wind torque.");
  v.number("wind_speed", section.wind_speed, unit::metre_per_second, "Mean.", known);
  v.text("objective", design::to_string(section.objective.kind), "Which rms is made least.");
  v.count("ensemble_members", section.members,
          "Plants on which every constraint is met; 0: the case's alone.");
  v.count("starts", section.starts, "Random starts of each controller.");
  v.count("rounds", section.rounds, "Of warm starts.");
  v.flag("settled", section.settled, "The last round gained nothing.");
  v.count("evaluations", section.evaluations, "Of controllers on plants.");
  v.number("tolerance", section.tolerance, unit::ratio,
           "Relative, of the rms: controllers closer than this count as the same.", known);
  v.number("slew_distance", section.slew_distance / unit::millidegree.divisor,
           {.suffix = "deg", .divisor = 1e3}, "Of slew_time.", known);
  v.number("slew_rate", section.slew_rate, unit::millidegree_per_second, "At the sky.", known);
  v.number("tracking_rate", section.tracking_rate, unit::millidegree_per_second, "At the sky.",
           known);
  v.number("crest_factor", section.goals.crest_factor, unit::ratio, "Of gusts.", known);
  v.number("friction_slope", section.friction, slope_unit, "Of the linear plant.", known);
  v.number("friction_slope_at_tracking_rate", section.tracking_friction, slope_unit,
           "Of the friction curve.", known);
}

void describe_recommended(io::Visitor& v, const design::TuningStudy& tuned) {
  const design::TunedController* controller = recommended_tuned_controller(tuned);
  const design::TunedController example;
  const design::TunedController& row = controller != nullptr ? *controller : example;
  v.group_if("recommended_as_built", controller != nullptr,
             "The controller that tune recommends for the motors as built; null: none. Left out: "
             "interrupted.",
             [&] {
               v.text("structure", row.structure, "Of the controller.");
               v.word("tuned_for", to_string(row.tuned_for), {"nominal", "robust"},
                      "For the case's plant alone, or for all of the ensemble.");
               v.number("design_wind_speed", row.wind_speed, unit::metre_per_second, "Mean.",
                        known);
               v.object("design", row.design, "On the case's plant.");
             });
}

}  // namespace

void describe(io::Visitor& v, const MatchMargins& cut) {
  v.defined_as("match_margins",
               "Margins of a controller on the case's plant, the loop cut at one place.");
  io::describe_break(v, "break", cut.loop_break);
  describe(v, cut.margins);
  v.number("sensitivity_peak", cut.margins.sensitivity.magnitude, unit::ratio, "Largest |S|.",
           {.minimum = 0.0});
}

void describe(io::Visitor& v, const MatchSection& section) {
  v.defined_as("matched", "The matching study: every structure tuned at every motor inertia.");
  describe_conditions(v, section);
  v.list("points", section.points, "By rising disks.",
         [&](const MatchPoint& point) { describe_point(v, point); });
  v.list("series", section.series, "One a structure.",
         [&](const MatchSeries& series) { describe_series(v, section, series); });
  std::vector<design::RankedMotors> ranked;
  if (!v.by_example()) ranked = ranked_motors(section);
  v.list("compared_motors", ranked,
         "Motors with their own recommended loops, as evaluate compares antennas, least first; "
         "empty without runs in wind.",
         [&](const design::RankedMotors& one) { describe_ranked(v, section, one); });
  v.list("variants", section.variants, "How the optimum moves, tuned on single plants.",
         [&](const MatchVariants& variants) { describe_variants(v, variants); });
  v.list("friction_thresholds", section.thresholds,
         "From which friction slope on the inertia matters no more.",
         [&](const FrictionThreshold& one) { describe_threshold(v, one); });
  v.list("rules", section.rules, "Classic rules, evaluated.",
         [&](const RuleVerdict& rule) { describe_rule(v, section, rule); });
  v.optional_members(section.wind_mast, [&](const plant::WindMast& mast) {
    v.object("wind_mast", mast, "Where the case names one.");
  });
  v.optional_members(section.tuned_as_built,
                     [&](const design::TuningStudy& tuned) { describe_recommended(v, tuned); });
  v.optional_members(section.what_if, [&](const design::WhatIfTable& table) {
    v.object("what_if", table,
             "The study's robust controllers, with fixed gains, on plants and in winds that they "
             "were not "
             "tuned for; only with --report.");
  });
}

}  // namespace boresight::app
