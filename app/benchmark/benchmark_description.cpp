#include <cmath>
#include <string>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr double per_meganewton = 1e6 / millidegree;  // rad/(N m) to mdeg/(MN m)
constexpr io::KeyUnit compliance_unit{.suffix = "mdeg_per_MN_m", .multiplier = per_meganewton};

// Per unit of torque, or of its impulse.
struct ResponseUnits {
  io::KeyUnit angle, square;
};

ResponseUnits response_units(std::string_view angle, std::string_view square) {
  return {{.suffix = angle, .multiplier = per_meganewton},
          {.suffix = square, .multiplier = std::pow(per_meganewton, 2)}};
}

void describe_course(io::Visitor& v, const control::ResponseScore& course,
                     const ResponseUnits& units, double torque) {
  v.number("peak", course.peak, units.angle, "Largest magnitude.");
  v.number("time_of_peak", course.time_of_peak, unit::second,
           "When; null where approached asymptotically.");
  v.number("final", course.final_value, units.angle, "Final boresight angle.");
  v.number(
      "return_time", course.return_time, unit::second,
      "After which the boresight error stays within return_fraction_1 of the peak about its end; "
      "null if it "
      "does not within watched_s.");
  v.number("squared_error_integral", course.integral_squared_error, units.square,
           "Over all time, about the end.");
  v.number("peak_at_design_torque", course.peak * torque, unit::millidegree,
           "For the torque rms of the design wind.");
  v.number("watched", course.horizon, unit::second, "For peak and return.");
}

void describe_break(io::Visitor& v, const design::BreakScore& score) {
  io::describe_break(v, "loop_break", score.loop_break);
  v.flag("exists", score.margins.has_value(), "Whether the controller has such a loop.");
  v.optional_members(score.margins, [&](const control::Margins& margins) {
    io::describe_sensitivity(v, margins);
    describe(v, margins);
  });
}

std::string condition_of(const design::WindScore& wind) {
  return fmt::format("{}, {:g} m/s{}{}", plant::to_string(wind.model), wind.mean_speed,
                     wind.attitude.empty() ? "" : ", ", wind.attitude);
}

void describe_wind(io::Visitor& v, const design::WindScore& wind) {
  v.text("condition", condition_of(wind), "Model, speed and attitude.");
  v.text("wind_model", plant::to_string(wind.model), "Of the wind torque.");
  v.number("mean_speed", wind.mean_speed, unit::metre_per_second, "Of the wind.");
  v.number("torque_coefficient", wind.torque_coefficient, unit::ratio, "Of the attitude.");
  v.number("torque_rms", wind.torque_rms, unit::newton_metre, "At the antenna's axis.");
  v.number("wind_rms", wind.wind_rms, unit::millidegree, "Of the boresight, from wind alone.");
  v.number("boresight_rms", wind.boresight_rms, unit::millidegree, "With the sensors' noise.");
}

void describe_compliance(io::Visitor& v, const design::RejectionScore& score) {
  const double held = score.flexure_compliance;
  v.number("worst_at_least", score.worst.lower, compliance_unit, "Largest, at its frequency.");
  v.number("worst_at_most", score.worst.upper, compliance_unit, "No frequency has more.");
  v.number("worst_frequency", score.worst.frequency, unit::hertz_of_radians, "Where it is.");
  v.number("static", score.static_compliance, compliance_unit, "Under a constant torque.");
  v.number("flexure", held, compliance_unit,
           "The same with the encoder fixed: flexure beyond the encoder.");
  v.number("worst_to_flexure", score.worst.lower / held, unit::ratio,
           "worst_at_least over flexure.");
  v.number("step_peak_to_flexure", score.step.peak / held, unit::ratio,
           "Peak after the torque step over flexure.");
}

// A pointing budget and the wind speed up to which it is met.
struct BudgetSpeed {
  design::PointingBudget budget;
  double speed = 0.0;
  std::optional<double> simulated;
};

void describe_budgets(io::Visitor& v, const BenchmarkReport& report) {
  std::vector<BudgetSpeed> budgets;
  for (std::size_t i = 0; i < report.score.budget_speeds.size(); ++i) {
    const auto& simulated = report.simulated_budget_speeds;
    budgets.push_back({report.budgets.at(i), report.score.budget_speeds[i],
                       i < simulated.size() ? std::optional(simulated[i]) : std::nullopt});
  }
  v.list("budgets", budgets, "Wind speeds up to which pointing budgets are met.",
         [&](const BudgetSpeed& one) {
           v.text("name", one.budget.name, "Its name.");
           v.text("band", one.budget.band, "That it is for.");
           v.number("rms", one.budget.rms, unit::millidegree, "Allowed, one axis.");
           v.text("convention", one.budget.convention, "What the loss is taken of.");
           v.number("wind_speed_limit", one.speed, unit::metre_per_second,
                    "Mean speed up to which it is met, linear; null: at every speed searched.");
           v.number("simulated_wind_speed_limit", one.simulated, unit::metre_per_second,
                    "The same by simulation, limit cycle included; null also without one.");
         });
}

void describe_reference(io::Visitor& v, const design::RejectionReference& reference, double rms) {
  const auto ratio = [&](const std::optional<double>& to) {
    return to && *to > 0.0 ? std::optional(rms / *to) : std::nullopt;
  };
  v.number("flexure_rms", reference.flexure_rms, unit::millidegree,
           "Boresight rms with the encoder fixed.");
  v.number("min_rms", reference.min_rms, unit::millidegree,
           "Lower bound over linear sampled controllers at the limit of control effort; null where "
           "a sensor has no noise.");
  v.number("min_rms_at_own_effort", reference.min_rms_at_own_effort, unit::millidegree,
           "The same at this controller's own control effort.");
  v.number("to_flexure", ratio(reference.flexure_rms), unit::ratio,
           "Boresight rms in the design wind over flexure_rms.");
  v.number("to_min", ratio(reference.min_rms), unit::ratio, "The same over min_rms.");
  v.number("to_min_at_own_effort", ratio(reference.min_rms_at_own_effort), unit::ratio,
           "The same over min_rms_at_own_effort.");
}

void describe_ensemble(io::Visitor& v, const design::RejectionEnsemble& ensemble,
                       std::string_view source) {
  const auto count = static_cast<double>(ensemble.members.size());
  v.text("source", source, "Distribution that the plants are sampled from.");
  v.number("stable_fraction", ensemble.stable / count, unit::ratio, "Of the plants.");
  v.number("within_constraints_fraction", ensemble.within_constraints / count, unit::ratio,
           "Of the plants.");
  v.number("largest_boresight_rms", ensemble.largest_rms, unit::millidegree, "Of the stable ones.");
  v.list("members", ensemble.members, "One a plant.", [&](const design::RejectionMember& member) {
    v.text("name", member.name, "Of the plant.");
    v.flag("stable", member.stable, "Whether the loop is.");
    v.flag("within_constraints", member.within_constraints, "Whether it meets every constraint.");
    v.number("boresight_rms", member.boresight_rms, unit::millidegree, "In the design wind.");
    v.number("control_effort", member.control_effort, unit::radian_per_second,
             "Rms of the valve command from the sensors' noise.");
    v.numbers("sensitivity_peaks", member.sensitivity_peaks, unit::ratio,
              "Peak of |S| at each break, null where there is none.");
  });
}

void describe_nonlinear(io::Visitor& v, const design::NonlinearVerification& result) {
  v.number("simulated_boresight_rms", result.wind.boresight_rms, unit::millidegree,
           "In the design wind.");
  v.number("linear_prediction", result.wind.predicted_rms, unit::millidegree,
           "The same by the spectrum.");
  v.list("limit_cycles", result.limit_cycles, "Without wind and noise at a steady rate.",
         [&](const design::LimitCycleResult& one) {
           v.word("motion", one.rate == 0.0 ? "at rest" : "at the tracking rate",
                  {"at rest", "at the tracking rate"}, "Which rate.");
           describe(v, one, io::LimitCycleDetail::score);
         });
  const auto error = [&](double design::ReversalResult::*of) {
    return result.reversal ? std::optional((*result.reversal).*of) : std::nullopt;
  };
  v.number("reversal_boresight_error", error(&design::ReversalResult::boresight_error),
           unit::millidegree, "Largest after a slow reversal, about the mean.");
  v.number("reversal_encoder_error", error(&design::ReversalResult::encoder_error),
           unit::millidegree, "Largest after a slow reversal.");
}

void describe_comparison(io::Visitor& v, const BenchmarkReport& report) {
  v.text("with", report.compared_with, "The other sheet.");
  v.list("quantities", report.comparison, "Of both scores.", [&](const ComparedQuantity& row) {
    const bool both = row.own && row.other && *row.other != 0.0;
    v.text("quantity", row.quantity, "Its place in the score, unit included.");
    v.number("this", row.own, unit::none, "Of this sheet.");
    v.number("other", row.other, unit::none, "Of the other.");
    v.number("ratio", both ? std::optional(*row.own / *row.other) : std::nullopt, unit::ratio,
             "this over other.");
  });
}

void describe_controller(io::Visitor& v, const BenchmarkReport& report) {
  const auto& system = report.controller.system;
  const bool sampled = system.sample_time > 0.0;
  v.text("description", report.controller.description, "In words.");
  v.word("form", sampled ? "sampled" : "continuous", {"sampled", "continuous"},
         "Of its equations.");
  v.number("sample_time", sampled ? std::optional(system.sample_time) : std::nullopt, unit::second,
           "Null for a continuous controller.");
  v.number("dead_time", report.dead_time, unit::second, "Of the loop.");
  v.count("states", system.a.rows(), "How many.");
  v.texts("inputs", system.inputs, "What it is given.");
  v.texts("outputs", system.outputs, "What it commands.");
  v.texts("remarks", report.remarks, "What is to be known of it.");
}

void describe_conditions(io::Visitor& v, const BenchmarkReport& report) {
  const design::RejectionScore& score = report.score;
  v.flag("plant_from_records", report.from_records,
         "Whether plant and ensemble are what the case's records show; else what it states.");
  v.text("wind_model", plant::to_string(report.wind.model), "Of the wind torque.");
  v.number("design_wind_speed", report.wind.mean_speed, unit::metre_per_second, "Mean.");
  v.number("torque_coefficient", report.wind.site.torque_coefficient, unit::ratio,
           "Of the wind torque.");
  v.number("design_torque_rms",
           score.stable ? std::optional(score.design_wind.torque_rms) : std::nullopt,
           unit::newton_metre,
           "Of the design wind, at the antenna's axis; null for an unstable loop.");
  v.text("attitudes", report.attitudes_text, "Evaluated conditions.");
  v.number("gear_ratio", report.gear_ratio, unit::ratio, "Motor turns per turn of the axis.");
  v.number("band_lowest", report.rms_band.lowest, unit::hertz, "Of the band of every rms.");
  v.number("band_highest", report.rms_band.highest, unit::hertz, "Of the band of every rms.");
  v.number("return_fraction", control::ResponseOptions{}.return_fraction, unit::ratio,
           "Of return_time_s.");
}

}  // namespace

void describe_score(io::Visitor& v, const BenchmarkReport& report) {
  const design::RejectionScore& score = report.score;
  const double torque = score.design_wind.torque_rms;
  v.group("torque_step", "Boresight response to a torque step, per torque at the antenna's axis.",
          [&] {
            describe_course(v, score.step,
                            response_units("mdeg_per_MN_m", "mdeg2_s_per_MN_m_squared"), torque);
          });
  v.group("torque_impulse", "Boresight response to a torque impulse.", [&] {
    describe_course(v, score.impulse,
                    response_units("mdeg_per_MN_m_s", "mdeg2_s_per_MN_m_s_squared"), torque);
  });
  v.group("compliance", "|boresight error/torque| over frequency.",
          [&] { describe_compliance(v, score); });
  v.list("loop_breaks", score.breaks, "Margins of the loop cut at each break.",
         [&](const design::BreakScore& one) { describe_break(v, one); });
  v.group("noise", "What the sensors' noise does.", [&] {
    v.number("boresight_rms", score.noise_rms, unit::millidegree, "At the sky, one axis.");
    v.number("control_effort", score.control_effort, unit::radian_per_second,
             "Rms of the valve command.");
  });
  v.group("design_wind", "At the case's design wind.", [&] {
    describe_wind(v, score.design_wind);
    v.number("lyapunov_boresight_rms", score.lyapunov_rms, unit::millidegree,
             "boresight_rms_mdeg by independent code: Lyapunov equations with a shaping filter.");
  });
  v.list("winds", score.winds, "The protocol's ladder.",
         [&](const design::WindScore& wind) { describe_wind(v, wind); });
  describe_budgets(v, report);
  v.optional_group("reference", score.reference,
                   "Against the best that any controller could do; null if left out.",
                   [&](const design::RejectionReference& reference) {
                     describe_reference(v, reference, score.design_wind.boresight_rms);
                   });
  v.optional_group("ensemble", score.ensemble, "On the plant ensemble; null if omitted.",
                   [&](const design::RejectionEnsemble& ensemble) {
                     describe_ensemble(v, ensemble, report.ensemble_source);
                   });
  v.optional_group(
      "nonlinear", report.time_domain, "On the nonlinear antenna; null where not evaluated.",
      [&](const TimeDomainSection& section) { describe_nonlinear(v, section.result); });
  v.list("compliance_curve", score.compliance,
         "|boresight error/torque| at the protocol's frequencies.",
         [&](const design::CompliancePoint& point) {
           v.number("frequency", point.frequency, unit::hertz, "Of the torque.");
           v.number("compliance", point.compliance, compliance_unit, "There.");
         });
}

void describe(io::Visitor& v, const BenchmarkReport& report) {
  const design::RejectionScore& score = report.score;
  describe_origin(v, "benchmark");
  v.constant("protocol_version", std::uint64_t{design::rejection_protocol},
             "Of docs/benchmark-protocol.md: sheets of other numbers do not compare.");
  describe_case(v, report.case_path, report.title, report.axis);
  v.count("seed", report.seed, "Of the ensemble's samples and the nonlinear runs.");
  v.flag("interrupted", report.interrupted, "The user stopped the work: parts are left out.");
  v.texts("left_out", score.left_out, "Parts that were left out.");
  v.group("controller", "What is scored.", [&] { describe_controller(v, report); });
  v.group("conditions", "What the scores hold for.", [&] { describe_conditions(v, report); });
  v.group("stability", "Of the linear loop, dead time exact.", [&] {
    v.flag("stable", score.stable, "Whether it is.");
    v.number("slowest_pole", score.abscissa, unit::per_second, "Its real part.");
    v.flag("rate_loop_alone_stable", score.rate_loop_stable,
           "With the position loop open; null where the controller has no rate loop.");
  });
  v.group_if("score", score.stable, "The scores; null for an unstable loop.",
             [&] { describe_score(v, report); });
  v.text_or_null("no_nonlinear_score", report.no_time_domain,
                 "Why the nonlinear antenna was not evaluated; null if it was.");
  v.group_if("comparison", !report.compared_with.empty(),
             "Beside another sheet; null without --compare.",
             [&] { describe_comparison(v, report); });
  describe_figures(v, report.figures);
  v.list("assumed_inputs", report.assumed, "Inputs of the case that are assumed.",
         [&](const io::Quantity& quantity) {
           v.text("key", quantity.key, "Its key in the case file.");
           v.text("as_written", quantity.text, "With its unit.");
         });
  describe_renamed_keys(v);
}

std::string to_json(const BenchmarkReport& report) {
  return json_of(report).dump(2) + "\n";
}

}  // namespace boresight::app
