#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/table_columns.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr double per_meganewton = 1e6 / millidegree;

std::string value(double number, const char* format = "{:.4g}") {
  return std::isfinite(number) ? fmt::format(fmt::runtime(format), number) : "-";
}

std::string limit_text(double speed) {
  if (speed == 0.0) return "noise alone exceeds it";
  return std::isfinite(speed) ? fmt::format("{:.1f} m/s", speed) : "beyond 60 m/s";
}

Document course_part(const char* name, const char* unit, const control::ResponseScore& course,
                     double torque) {
  const std::string returned =
      course.return_time ? fmt::format("settling time (5 %) {:.3g} s", *course.return_time)
                         : fmt::format("not settled (5 %) in {:.3g} s", course.horizon);
  const std::string timed = std::isfinite(course.time_of_peak)
                                ? fmt::format("at {:.3g} s", course.time_of_peak)
                                : "approached asymptotically";
  return wrapped(
      fmt::format("{}: peak {:.4g} mdeg/{} {}, {}; ends at {:.4g} mdeg/{}; integral of the "
                  "squared error {:.4g} mdeg2 s/{}2. At the design wind's torque rms, {:.4g} kN m, "
                  "the peak is {:.4g} mdeg{}.",
                  name, course.peak * per_meganewton, unit, timed, returned,
                  course.final_value * per_meganewton, unit,
                  course.integral_squared_error * std::pow(per_meganewton, 2), unit, torque / 1e3,
                  course.peak * torque / millidegree,
                  unit == std::string("(MN m s)") ? " for 1 s of it" : ""),
      "  ", "  ");
}

Document margins_part(const design::RejectionScore& score) {
  std::vector<std::vector<std::string>> rows{{"loop cut at", "Ms", "at Hz"}};
  const auto append = [](std::vector<std::string>& row, const std::vector<std::string>& cells) {
    row.insert(row.end(), cells.begin(), cells.end());
  };
  append(rows.front(), columns_of(control::Margins{}).headings);
  for (const auto& one : score.breaks) {
    std::vector<std::string> row{std::string(control::to_string(one.loop_break))};
    if (!one.margins) {
      row.emplace_back("no such loop");
      row.resize(rows.front().size(), "-");
    } else {
      const auto& peak = one.margins->sensitivity;
      append(row, {value(peak.magnitude, "{:.3f}"), value(peak.frequency / two_pi, "{:.3g}")});
      append(row, columns_of(*one.margins).cells);
    }
    rows.push_back(std::move(row));
  }
  return table(rows);
}

Document ladder_part(const std::vector<design::WindScore>& winds) {
  // A row a model and attitude, a column a speed.
  std::vector<std::vector<std::string>> rows{{"boresight rms, mdeg"}};
  for (const double speed : design::rejection_speeds)
    rows[0].push_back(fmt::format("{:g} m/s", speed));
  std::string before;
  for (const auto& wind : winds) {
    const std::string name = fmt::format("{}{}{}", plant::to_string(wind.model),
                                         wind.attitude.empty() ? "" : ", ", wind.attitude);
    if (name != before) rows.push_back({name});
    before = name;
    rows.back().push_back(value(wind.boresight_rms / millidegree, "{:.3f}"));
  }
  return table(rows);
}

Document reference_part(const BenchmarkReport& report) {
  if (!report.score.reference) return {};
  const auto& reference = *report.score.reference;
  const double rms = report.score.design_wind.boresight_rms;
  std::string text = fmt::format(
      "Boresight rms {:.4g} mdeg is {:.3f} times the flexure beyond the encoder ({:.4g} mdeg with "
      "the encoder fixed; not a lower bound)",
      rms / millidegree, rms / reference.flexure_rms, reference.flexure_rms / millidegree);
  if (reference.min_rms && reference.min_rms_at_own_effort &&
      *reference.min_rms_at_own_effort > 0.0) {
    text += fmt::format(
        ", {:.3f} times the lower bound of linear sampled controllers at the limit of control "
        "effort ({:.4g} mdeg) and {:.3f} times that at its own effort ({:.4g} mdeg). The bounds "
        "ignore margins.",
        rms / *reference.min_rms, *reference.min_rms / millidegree,
        rms / *reference.min_rms_at_own_effort, *reference.min_rms_at_own_effort / millidegree);
  } else {
    text += "; without stated sensor noise there is no lower bound.";
  }
  return wrapped(text, "  ", "  ");
}

// Where the plant comes from, its friction included.
const char* described(const BenchmarkReport& report) {
  return report.from_records ? "as the case's records show it" : "as the case states it";
}

Document nonlinear_part(const TimeDomainSection& section, const char* friction) {
  std::string text;
  for (const auto& one : section.result.limit_cycles) {
    const std::string motion = one.rate == 0.0 ? "At rest" : "At the tracking rate";
    if (one.status != design::RunStatus::complete) {
      text += fmt::format("{}: run {}. ", motion, design::to_string(one.status));
    } else if (one.limit_cycle) {
      text += fmt::format("{}: limit cycle of +-{:.3g} mdeg at the boresight{}. ", motion,
                          one.boresight_amplitude / millidegree,
                          one.frequency ? fmt::format(", {:.3g} Hz", *one.frequency) : "");
    } else {
      text += fmt::format("{}: no limit cycle above the encoder's resolution. ", motion);
    }
  }
  const auto& reversal = section.result.reversal;
  if (reversal && reversal->status == design::RunStatus::complete) {
    text += fmt::format(
        "Velocity reversal at tracking rate: boresight error {:.3g} mdeg, encoder {:.3g} mdeg. ",
        reversal->boresight_error / millidegree, reversal->encoder_error / millidegree);
  }
  text += fmt::format(
      "One record of the design wind on the nonlinear antenna: {:.4g} mdeg rms, {:.4g} predicted "
      "by "
      "the linear loop. Sampled every {:g} s; friction {}.",
      section.result.wind.boresight_rms / millidegree,
      section.result.wind.predicted_rms / millidegree, section.sample_time, friction);
  return wrapped(text, "  ", "  ");
}

Document comparison_part(const BenchmarkReport& report) {
  std::vector<std::vector<std::string>> rows{{"quantity", "this", "other", "this/other"}};
  for (const auto& row : report.comparison) {
    const bool both = row.own && row.other && *row.other != 0.0;
    rows.push_back({row.quantity, row.own ? value(*row.own, "{:.5g}") : "-",
                    row.other ? value(*row.other, "{:.5g}") : "-",
                    both ? value(*row.own / *row.other, "{:.4f}") : "-"});
  }
  return heading("Comparison with another score sheet") +
         essential(wrapped(report.compared_with, "  ", "  ") + "\n" + table(rows));
}

}  // namespace

Document document_of(const BenchmarkReport& report) {
  const design::RejectionScore& score = report.score;
  const auto& system = report.controller.system;
  std::vector<std::string> read = system.inputs;
  std::erase(read, "rate_disturbance");
  Document text = report_title("benchmark", report.title, words_beside(report.title, report.axis),
                               report.case_path, std::nullopt);
  text += lead(decision(report));
  text += heading(fmt::format("Disturbance rejection, protocol {}", design::rejection_protocol));
  text += essential(wrapped(
      fmt::format("Controller: {}; {}, {} states, reads {}.", report.controller.description,
                  system.sample_time > 0.0
                      ? fmt::format("sampled every {:g} s with one sample of computation",
                                    system.sample_time)
                      : fmt::format("continuous with a dead time of {:g} s", report.dead_time),
                  system.a.rows(), fmt::join(read, ", ")),
      "  ", "  "));
  for (const auto& remark : report.remarks) text += essential(wrapped(remark, "  ", "  "));
  text += wrapped(
      fmt::format(
          "Linear plant {}; wind model {}, design wind {:g} m/s, {}; rms per axis over {:g} to "
          "{:g} Hz about the mean. Torques at the antenna's axis, angles at the sky.",
          described(report), plant::to_string(report.wind.model), report.wind.mean_speed,
          report.attitudes_text, report.rms_band.lowest, report.rms_band.highest),
      "  ", "  ");
  if (!score.stable) {
    text += essential(wrapped(
        fmt::format(
            "The closed loop is UNSTABLE: slowest pole at {:+.4g} 1/s (dead time exact). An "
            "unstable loop has no score.",
            score.abscissa),
        "  ", "  "));
    if (report.present_gains && report.controller.controller) {
      text += wrapped(unstable_present_gains(report.controller.controller->structure.name()), "  ",
                      "  ");
    }
    return text + document_of(report.assumed);
  }
  text += fmt::format("  Stable: slowest pole at {:.4g} 1/s.{}\n", score.abscissa,
                      !score.rate_loop_stable   ? " No separate rate loop."
                      : *score.rate_loop_stable ? " Rate loop alone stable."
                                                : " Rate loop alone UNSTABLE.");
  text += heading("Torque at the dish");
  text += course_part("Step", "(MN m)", score.step, score.design_wind.torque_rms);
  text += course_part("Impulse", "(MN m s)", score.impulse, score.design_wind.torque_rms);
  const std::string bracket =
      score.worst.closed
          ? fmt::format("{:.6g} to {:.6g} mdeg/(MN m), certified maximum",
                        score.worst.lower * per_meganewton, score.worst.upper * per_meganewton)
          : fmt::format("at least {:.6g} mdeg/(MN m), no upper bound certified",
                        score.worst.lower * per_meganewton);
  text += essential(wrapped(
      fmt::format(
          "Worst frequency {:.4g} Hz: {}, {:.3g} times the structural flexure with "
          "the encoder fixed, {:.4g} mdeg/(MN m). Static: {:.4g} mdeg/(MN m).",
          score.worst.frequency / two_pi, bracket, score.worst.lower / score.flexure_compliance,
          score.flexure_compliance * per_meganewton, score.static_compliance * per_meganewton),
      "  ", "  "));
  text += heading("Margins");
  text += essential(margins_part(score));
  text += heading("Wind");
  text += wrapped(
      fmt::format("In the design wind: boresight {:.4g} mdeg rms ({:.4g} by Lyapunov equations "
                  "with the wind's filter), {:.4g} from wind, {:.4g} from sensor noise. Control "
                  "effort {:.4g} rad/s, limit {:g}.",
                  score.design_wind.boresight_rms / millidegree, score.lyapunov_rms / millidegree,
                  score.design_wind.wind_rms / millidegree, score.noise_rms / millidegree,
                  score.control_effort, report.goals.control_effort),
      "  ", "  ");
  if (score.reference) text += reference_part(report);
  if (!score.winds.empty()) text += "\n" + essential(ladder_part(score.winds));
  if (!score.budget_speeds.empty()) {
    const auto& simulated = report.simulated_budget_speeds;
    std::vector<std::vector<std::string>> rows{{"budget", "rms mdeg", "met up to, linear"}};
    if (!simulated.empty()) rows[0].emplace_back("simulated, limit cycle included");
    for (std::size_t i = 0; i < score.budget_speeds.size(); ++i) {
      rows.push_back({fmt::format("{} ({})", report.budgets[i].name, report.budgets[i].band),
                      value(report.budgets[i].rms / millidegree, "{:.3f}"),
                      limit_text(score.budget_speeds[i])});
      if (i < simulated.size()) rows.back().push_back(limit_text(simulated[i]));
    }
    text += essential("\n" + table(rows));
  }
  if (score.ensemble) {
    const auto& ensemble = *score.ensemble;
    text += heading("Perturbed plants");
    text += essential(wrapped(
        fmt::format("Of {} plants {}, {} are stable and {} keep Ms and control effort within their "
                    "limits. Largest boresight rms of the stable ones: {:.4g} mdeg.",
                    ensemble.members.size(), report.ensemble_source, ensemble.stable,
                    ensemble.within_constraints, ensemble.largest_rms / millidegree),
        "  ", "  "));
  }
  text += heading("Nonlinear antenna");
  text += essential(report.time_domain
                        ? nonlinear_part(*report.time_domain, described(report))
                        : wrapped("Not evaluated: " + report.no_time_domain + ".", "  ", "  "));
  for (const auto& part : score.left_out) {
    text += essential(verbatim(fmt::format("  Interrupted before: {}\n", part)));
  }
  if (!report.compared_with.empty()) text += comparison_part(report);
  return text + document_of(report.assumed);
}

std::string to_text(const BenchmarkReport& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
