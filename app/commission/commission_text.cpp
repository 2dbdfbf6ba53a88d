#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number(double value, const char* form) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(form), value) : "-";
}

std::string stage_name(const design::CommissioningStage& stage) {
  const auto kind = to_string(stage.kind);
  return stage.steps == 1 ? std::string(kind)
                          : fmt::format("{}, {} of {}", kind, stage.step, stage.steps);
}

Document overview(const CommissionReport& report) {
  Rows rows{{"stage", "", "position", "peak of S", "crossover Hz", "rise s", "overshoot %",
             "valve rms rad/s", "beam rms mdeg", "stable plants"}};
  const double sky = report.gear_ratio * millidegree;
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& stage = report.sheets[i].stage;
    const auto& expected = stage.expected;
    rows.push_back({fmt::format("{}", i + 1), stage_name(stage),
                    stage.law.position_open ? "open" : "closed",
                    number(expected.peak.largest, "{:.2f}"),
                    number(expected.crossover.nominal / two_pi, "{:.4f}"),
                    number(expected.rise_time.nominal, "{:.2f}"),
                    number(100.0 * expected.overshoot.nominal, "{:.0f}"),
                    number(expected.still_valve.nominal, "{:.4f}"),
                    number(expected.beam_rms.nominal / sky, "{:.4f}"),
                    fmt::format("{}/{}", expected.stable, expected.plants)});
  }
  return table(rows, "rll") +
         wrapped(
             "Peak of S: the largest over all plants and the loops that are closed. The rest: on "
             "the case's own plant; valve rms in still air, beam rms in the design wind.",
             "  ");
}

Document sheets(const CommissionReport& report) {
  Document text;
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& sheet = report.sheets[i];
    text += subheading(fmt::format("{} {}{}", i + 1, stage_name(sheet.stage),
                                   sheet.stage.law.position_open ? ", position loop open" : ""));
    std::vector<std::string> gains;
    for (const auto& gain : sheet.gains) {
      gains.push_back(fmt::format("{} = {}{}", gain.symbol, gain.text, gain.changed ? " *" : ""));
    }
    text += wrapped(fmt::format("gains  {}", fmt::join(gains, "; ")), "    ", "       ");
    text += wrapped("check  " + sheet.check, "    ", "       ");
    text += wrapped("abort  " + sheet.abort, "    ", "       ");
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
      text += wrapped(fmt::format("{}: cannot be compared: {}", to_string(channel.quantity),
                                  channel.not_compared),
                      "  ");
      continue;
    }
    const std::string unit(unit_of(channel.quantity));
    Rows rows{{std::string(to_string(channel.quantity)), "Hz", "before " + unit, "after " + unit,
               "ratio", "from", "to", "freedom before", "after", "verdict"}};
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
  return text +
         wrapped(
             "Rms about a straight line in each segment; ratio: after over before, with its 95 % "
             "interval for two stationary records under the same disturbance, which the records "
             "themselves do not show: note wind and elevation of both. Freedom: of how many "
             "independent squares a mean square is worth.",
             "  ");
}

Document plan_part(const CommissionReport& report) {
  Document text;
  text += wrapped(
      fmt::format(
          "The gains at the end are {}. {} plants that may be the true one, {}; wind {:g} "
          "m/s, {} model. Values in brackets: where one more such plant would lie with {:g} %.",
          report.tuned ? "those of the robust tuning" : "those given", report.ensemble_size,
          report.ensemble_source, report.wind_speed, report.wind_model,
          100.0 * report.options.confidence),
      "  ");
  if (report.plan.detuning) {
    const bool known = report.plan.stages.front().kind == design::StageKind::as_found;
    text += essential(wrapped(
        fmt::format(
            "{} The plan begins with the law's own without pressure feedback and "
            "compliance compensation, its {}position gain and position integral corner divided by "
            "{:g}: the least power of two at which every plant keeps its peaks of S below {:g}.",
            known ? "ASSUMED start: no way was found from the gains as found ([gains], stage 1) to "
                    "this law; why stands below."
                  : "ASSUMED start: the case gives no gains as found ([gains]).",
            report.plan.rate_detuned ? "rate gain, " : "", *report.plan.detuning,
            report.options.sensitivity_limit),
        "  "));
  }
  for (const auto& remark : report.plan.remarks) text += wrapped(remark, "  ");
  text += wrapped(
      fmt::format("All of this is the linear plant's: make steps from a slow steady motion, clear "
                  "of breakaway, in still air, no larger than stated (a fifth of the valve's "
                  "stroke and of the supply's torque). The move: up to {:.3g} mdeg/s in {:.3g} s, "
                  "steady, and down again. The rms in still air rest on the case's sensor noise: "
                  "hold the first stage's against a record and scale the others by what it shows.",
                  report.move.rate / (report.gear_ratio * millidegree),
                  report.move.rate / report.move.acceleration),
      "  ");
  text += essential(wrapped(
      fmt::format(
          "A stage is passed when every value lies in its brackets, an rms within {:g} times them. "
          "Go back when one is beyond its abort limit: {:.0f} % of the step above the brackets for "
          "an overshoot, {:g} times the brackets for an rms, or less where the worst plant's peak "
          "of S would be {:g}. Between the two, find out why before going on.",
          report.options.rms_allowance, 100.0 * report.options.overshoot_allowance,
          report.options.rms_allowance, report.options.abort_peak),
      "  "));
  text += "\n" + essential(overview(report));
  text += heading("Stages (* changed against the stage before)") + essential(sheets(report));
  return text;
}

}  // namespace

Document document_of(const CommissionReport& report) {
  Document text =
      report_title("commission", report.title, words_of(report.axis), report.case_path, report.seed);
  text += lead(decision(report));
  text += heading("Commissioning plan for " + report.structure);
  text += report.failure == nullptr ? plan_part(report)
                                    : essential(wrapped("None: " + report.no_plan, "  "));
  text += comparison_part(report);
  text += heading("Conclusions");
  for (const auto& sentence : report.conclusions) text += wrapped("- " + sentence, "  ", "  ");
  return text + document_of(report.assumed);
}

std::string to_text(const CommissionReport& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
