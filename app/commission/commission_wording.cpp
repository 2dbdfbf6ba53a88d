#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/commission/commission_findings.hpp>
#include <boresight/app/commission/commission_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::PlantBand;
using design::StageKind;

std::string range(const PlantBand& band, double unit, int digits) {
  return fmt::format("{:.{}g} ({:.{}g} to {:.{}g})", band.nominal / unit, digits, band.lower / unit,
                     digits, band.upper / unit, digits);
}

void describe_reserve(const CommissionReport& report, StageSheet& sheet) {
  const auto& abort = sheet.stage.abort;
  if (!sheet.stage.expected.all_stable()) {
    sheet.reserve = fmt::format(
        "{} of {} plants are unstable with these gains, but the antenna runs on them: nothing is "
        "predicted.",
        sheet.stage.expected.plants - sheet.stage.expected.stable, sheet.stage.expected.plants);
    return;
  }
  sheet.reserve =
      std::isfinite(abort.gain_reserve)
          ? fmt::format("Ms reaches {:g} on the worst plant ({}) at {:.2f} times this loop gain.",
                        report.options.abort_peak, abort.worst_plant, abort.gain_reserve)
          : fmt::format("Ms stays below {:g} on every plant even at 8 times this loop gain.",
                        report.options.abort_peak);
}

void describe_way_back(const StageSheet* before, StageSheet& sheet) {
  const auto kind = sheet.stage.kind;
  if (before == nullptr || before->stage.kind == StageKind::as_found) {
    sheet.way_back = "Brakes on, then the gains as found.";
    if (before == nullptr) {
      sheet.way_back = "Brakes on; nothing has been changed yet.";
    } else if (!before->stage.expected.all_stable()) {
      sheet.way_back = "Brakes on. Restore the gains as found only if the antenna did run on them.";
    }
  } else if (kind == StageKind::feedforward) {
    sheet.way_back = "Switch feedforward off: the loops are as they were.";
  } else if (kind == StageKind::output) {
    sheet.way_back = "Set the output factor of the stage before; brakes on if it oscillates.";
  } else if (sheet.stage.controller.position_open) {
    sheet.way_back = "Rate command to zero, then the gains of the stage before.";
  } else if (before->stage.controller.position_open) {
    sheet.way_back = "Open the position loop (rate command zero); the rate loop keeps its gains.";
  } else {
    sheet.way_back = "Open the position loop, set the gains of the stage before, close it again.";
  }
}

std::vector<StageGain> stage_gains(const io::GainUnits& units, const design::StageController& stage,
                                   const design::StageController* before) {
  const auto texts = units.texts(stage.controller);
  std::vector<StageGain> gains;
  if (stage.controller.structure.state_space() != nullptr) {
    const double factor = stage.output_factor;
    const bool changed =
        before != nullptr &&
        (before->output_factor != factor || before->controller.structure.state_space() == nullptr);
    return {{"k", "factor on the output of the state space", fmt::format("{:.4g}", factor), factor,
             changed}};
  }
  for (const auto& [place, changed] : acting_gains(stage, before)) {
    const auto& description = stage.controller.structure.gains()[place];
    gains.push_back({description.symbol, description.name, texts[place],
                     stage.controller.gains[place], changed});
  }
  return gains;
}

void conclude_plan(const CommissionReport& report, const io::Case& antenna,
                   std::vector<std::string>& sentences) {
  if (report.limit_cycle) {
    sentences.push_back(fmt::format(
        "On the nonlinear antenna {} {}; the stages assume linear loops. Measure the friction "
        "before setting these gains, or plan for another controller.",
        report.structure,
        std::isfinite(*report.limit_cycle)
            ? fmt::format("has a limit cycle of +-{:.2f} mdeg, beyond the allowed amplitude",
                          *report.limit_cycle / millidegree)
            : std::string("does not complete a run in still air")));
  }
  const auto& first = report.plan.stages.front();
  const auto& last = report.plan.stages.back();
  const double sky = io::gear_ratio(antenna) * millidegree;
  if (!first.expected.all_stable()) {
    sentences.push_back(
        fmt::format("With the gains as found {} of {} plants are unstable, but the antenna runs on "
                    "them: the plant or the definition of a gain differs from the case. Check "
                    "leakage, inertia, units and definition of the gains before any stage.",
                    first.expected.plants - first.expected.stable, first.expected.plants));
  }
  const bool state_space = last.controller.controller.structure.state_space() != nullptr;
  sentences.push_back(fmt::format(
      "{} stages lead to {}{}. {} more than a factor of {:.3g} per stage; Ms is at most {:.2f} on "
      "each of {} plants at every stage.",
      report.plan.stages.size() - (first.kind == StageKind::as_found ? 1 : 0), report.structure,
      state_space ? fmt::format(" ({})", last.controller.controller.structure.name())
                  : std::string(),
      state_space ? "The first replaces all gains at reduced output; its factor k rises by no"
                  : "No gain changes by",
      report.plan.largest_step, report.plan.largest_peak(), last.expected.plants));
  if (first.kind == StageKind::as_found && std::isfinite(first.expected.boresight_rms.upper)) {
    sentences.push_back(fmt::format(
        "Boresight rms per axis at {:g} m/s ({} wind, linear; {:g} % prediction interval over the "
        "plants): {} mdeg as found, {} mdeg at the end.",
        report.wind_speed, report.wind_model, 100.0 * report.options.confidence,
        range(first.expected.boresight_rms, sky, 3), range(last.expected.boresight_rms, sky, 3)));
  } else {
    sentences.push_back(
        fmt::format("Boresight rms per axis at {:g} m/s ({} wind, linear; {:g} % prediction "
                    "interval over the plants) at the end: {} mdeg.",
                    report.wind_speed, report.wind_model, 100.0 * report.options.confidence,
                    range(last.expected.boresight_rms, sky, 3)));
  }
  sentences.insert(sentences.end(), report.bounds.begin(), report.bounds.end());
}

}  // namespace

std::vector<StageSheet> make_sheets(const io::Case& antenna, const CommissionReport& report,
                                    const design::CommissionStudy& study) {
  const io::GainUnits units(antenna);
  std::vector<StageSheet> sheets;
  sheets.reserve(report.plan.stages.size());
  for (std::size_t i = 0; i < report.plan.stages.size(); ++i) {
    const StageSheet* before = sheets.empty() ? nullptr : &sheets.back();
    StageSheet sheet;
    sheet.stage = report.plan.stages[i];
    sheet.gains = stage_gains(units, sheet.stage.controller,
                              before != nullptr ? &before->stage.controller : nullptr);
    sheet.step = study.steps[i];
    if (i < study.experiments.size()) sheet.experiment = study.experiments[i];
    sheet.checks = stage_checks(sheet.stage, report.units, report.options.rms_allowance);
    describe_reserve(report, sheet);
    describe_way_back(before, sheet);
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

std::vector<std::string> conclude(const CommissionReport& report, const io::Case& antenna) {
  std::vector<std::string> sentences;
  if (report.failure == nullptr) {
    sentences = about_records(report);
    conclude_plan(report, antenna, sentences);
    std::ranges::move(about_trials(report), std::back_inserter(sentences));
  } else {
    sentences.push_back(
        fmt::format("There is no plan for {}: {}", report.structure, report.no_plan));
  }
  for (const auto& channel : report.comparisons) {
    if (!channel.not_compared.empty()) continue;
    const auto& whole = channel.comparison.whole;
    std::string sentence = fmt::format(
        "{}, {:.3g} to {:.3g} Hz: rms after is {:.3g} times that before ({:.3g} to {:.3g}): {}.",
        to_string(channel.quantity), whole.lowest, whole.highest, whole.ratio, whole.lower,
        whole.upper, to_string(whole.change));
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    if (channel.predicted) {
      const auto& predicted = *channel.predicted;
      sentence +=
          fmt::format(" The plan predicts {:.3g} ({:.3g} to {:.3g}) in the design wind: {}.",
                      predicted.value, predicted.lower, predicted.upper,
                      agrees(channel.comparison, predicted) ? "they agree" : "they do not agree");
    }
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace boresight::app
