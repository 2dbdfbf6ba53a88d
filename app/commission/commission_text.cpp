#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_findings.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number(double value, const char* form) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(form), value) : "-";
}

Document overview(const CommissionReport& report) {
  Rows rows{{"stage", "", "position", "Ms", "crossover Hz", "rise s", "overshoot %",
             "valve rms rad/s", "boresight rms mdeg", "stable plants"}};
  const double sky = report.gear_ratio * millidegree;
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& stage = report.sheets[i].stage;
    const auto& expected = stage.expected;
    // With feedforward a move is made instead of a step.
    const double step =
        stage.controller.feedforward ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    rows.push_back({fmt::format("{}", i + 1), stage_name(stage),
                    stage.controller.position_open ? "open" : "closed",
                    number(expected.peak.largest, "{:.2f}"),
                    number(expected.crossover.nominal / two_pi, "{:.4f}"),
                    number(step * expected.rise_time.nominal, "{:.2f}"),
                    number(step * 100.0 * expected.overshoot.nominal, "{:.0f}"),
                    number(expected.calm_valve.nominal, "{:.4f}"),
                    number(expected.boresight_rms.nominal / sky, "{:.4f}"),
                    fmt::format("{}/{}", expected.stable, expected.plants)});
  }
  return table(rows, "rll") +
         wrapped(
             "Ms: largest over all plants and closed loops. Other columns: linear nominal plant; "
             "valve rms in still air, boresight rms in the design wind.",
             "  ");
}

std::string gain_text(const StageGain& gain) {
  return fmt::format("{} = {}", gain.symbol, gain.text);
}

// Of the first stage all that act, of the others those that change.
Document gains_to_set(const CommissionReport& report) {
  Rows rows{{"stage", "gains to set"}};
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    std::vector<std::string> gains;
    for (const auto& gain : report.sheets[i].gains) {
      if (i == 0 || gain.changed) gains.push_back(gain_text(gain));
    }
    rows.push_back({fmt::format("{}", i + 1),
                    gains.empty() ? "as before" : fmt::format("{}", fmt::join(gains, "; "))});
  }
  return table(rows, "rl");
}

Document sheets(const CommissionReport& report) {
  Document text;
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& sheet = report.sheets[i];
    text +=
        subheading(fmt::format("{} {}{}", i + 1, stage_name(sheet.stage),
                               sheet.stage.controller.position_open ? ", position loop open" : ""));
    std::vector<std::string> gains;
    for (const auto& gain : sheet.gains) {
      gains.push_back(gain_text(gain) + (gain.changed ? " *" : ""));
    }
    text += wrapped(fmt::format("gains  {}", fmt::join(gains, "; ")), "    ", "       ");
    if (!sheet.checks.empty()) {
      Rows rows{{command_in_words(report, sheet), "unit", "expected", "from", "to", "abort above"}};
      for (const auto& check : sheet.checks) {
        rows.push_back({std::string(to_string(check.quantity)), check.unit,
                        checked_number(check.expected), checked_number(check.lower),
                        checked_number(check.upper),
                        check.abort_above ? checked_number(*check.abort_above) : "-"});
      }
      text += table(rows, "ll");
      const std::string motion = motion_in_words(report, sheet);
      if (!motion.empty()) text += wrapped(motion, "    ", "       ");
    }
    text += wrapped(sheet.reserve, "    ", "       ");
    text += wrapped("back   " + sheet.way_back, "    ", "       ");
  }
  return text;
}

Document comparison_part(const CommissionReport& report) {
  if (report.comparisons.empty()) return {};
  Document text =
      heading(fmt::format("Before and after: '{}' and '{}'", report.before, report.after));
  for (const auto& channel : report.comparisons) {
    if (!channel.not_compared.empty()) {
      text += wrapped(
          fmt::format("{}: not comparable: {}", to_string(channel.quantity), channel.not_compared),
          "  ");
      continue;
    }
    const std::string unit(unit_of(channel.quantity));
    Rows rows{{std::string(to_string(channel.quantity)), "Hz", "before " + unit, "after " + unit,
               "ratio", "from", "to", "dof before", "after", "verdict"}};
    const auto add = [&](const design::BandComparison& band, const std::string& name) {
      rows.push_back({name, fmt::format("{:.3g} .. {:.3g}", band.lowest, band.highest),
                      fmt::format("{:.4g}", band.rms_before), fmt::format("{:.4g}", band.rms_after),
                      fmt::format("{:.3f}", band.ratio), fmt::format("{:.3f}", band.lower),
                      fmt::format("{:.3f}", band.upper), fmt::format("{:.0f}", band.freedom_before),
                      fmt::format("{:.0f}", band.freedom_after),
                      std::string(to_string(band.change))});
    };
    add(channel.comparison.whole, "whole");
    for (const auto& band : channel.comparison.bands) add(band, "");
    text += essential(table(rows, "ll") + "\n");
  }
  return text + wrapped(
                    "Rms about a straight line in each segment. Ratio: after/before with 95 % "
                    "interval, for stationary records under the same disturbance: note wind and "
                    "elevation of both. dof: equivalent degrees of freedom.",
                    "  ");
}

Document plan_part(const CommissionReport& report) {
  Document text;
  text += wrapped(fmt::format("Final gains: {}. Ensemble: {} plants, {}; wind {:g} m/s, {} model. "
                              "Brackets: {:g} % prediction interval.",
                              report.tuned ? "from robust tuning" : "as given",
                              report.ensemble_size, report.ensemble_source, report.wind_speed,
                              report.wind_model, 100.0 * report.options.confidence),
                  "  ");
  const auto& target = report.plan.stages.back().controller.controller.structure;
  if (target.state_space() != nullptr) {
    text += essential(wrapped(
        fmt::format("The controller: {}; --json has them too.", state_space_text(target)), "  "));
  }
  if (report.plan.detuning) {
    const bool integral =
        target.count(control::LoopPath::position, control::BlockKind::integral) > 0;
    const bool known = report.plan.stages.front().kind == design::StageKind::as_found;
    text += essential(wrapped(
        fmt::format(
            "{} The plan begins with the final gains, without pressure feedback and compliance "
            "compensation. The {}position gain{} {} divided by {:g}, the least power of two that "
            "keeps Ms below {:g} on every plant.",
            known ? "ASSUMED start: no path was found from the gains as found ([gains], stage 1) "
                    "to this controller."
                  : "ASSUMED start: the case gives no gains as found ([gains]).",
            report.plan.rate_detuned ? integral ? "rate gain, " : "rate gain and " : "",
            integral ? " and position integral corner" : "",
            integral || report.plan.rate_detuned ? "are" : "is", *report.plan.detuning,
            report.options.sensitivity_limit),
        "  "));
  }
  for (const auto& remark : report.plan.remarks) text += wrapped(remark, "  ");
  text += wrapped(
      fmt::format("{} Make steps and moves in still air, of the stated size (a fifth of valve "
                  "stroke and supply torque) and on the stated steady motion, clear of breakaway. "
                  "Rms values in still air assume the case's sensor noise: compare the first stage "
                  "with a record and scale the others.",
                  report.sheets.front().experiment
                      ? fmt::format("Steps and moves are expected of the nonlinear antenna: the "
                                    "brackets are those of the plants with what friction, orifices "
                                    "and limits add to the nominal one, friction torques within "
                                    "{:.0f} %.",
                                    100.0 * design::friction_allowance)
                      : std::string("Values hold for the linear plant.")),
      "  ");
  text += essential(wrapped(
      fmt::format(
          "A stage passes when every value lies within its brackets, which for an rms are {:g} "
          "times "
          "wider than over the plants. Go back when one exceeds its abort limit: for an overshoot "
          "{:.0f} % of the step "
          "above the brackets, for an rms at their end, or less where the worst plant's Ms would "
          "be {:g}, or on any ringing that does not decay. Between the two, find the cause first.",
          report.options.rms_allowance, 100.0 * report.options.overshoot_allowance,
          report.options.abort_peak),
      "  "));
  text += "\n" + essential(overview(report));
  text += essential("\n" + gains_to_set(report) +
                    wrapped("What to check at each stage, when to abort and the way back: section "
                            "Stages (--details).",
                            "  "));
  text += trials_part(report);
  text += heading("Stages (* changed from the previous stage)") + sheets(report);
  return text;
}

}  // namespace

Document document_of(const CommissionReport& report) {
  Document text = report_title("commission", report.title, words_beside(report.title, report.axis),
                               report.case_path, report.seed);
  text += lead(decision(report));
  text += heading("Commissioning plan for " + report.structure);
  text += report.failure == nullptr ? plan_part(report)
                                    : essential(wrapped("None: " + report.no_plan, "  "));
  text += records_part(report);
  text += comparison_part(report);
  text += heading("Conclusions");
  for (const auto& sentence : report.conclusions) text += wrapped("- " + sentence, "  ", "  ");
  return text + document_of(report.assumed);
}

std::string to_text(const CommissionReport& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
