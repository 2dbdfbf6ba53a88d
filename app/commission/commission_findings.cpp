#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_findings.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using design::StageVerdict;
using Rows = std::vector<std::vector<std::string>>;

double percentage(std::size_t part, std::size_t all) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

std::string in_units(const CommissionReport& report, design::StageQuantity quantity, double value) {
  const QuantityUnit unit = unit_of(quantity, report.units);
  return fmt::format("{} {}", checked_number(unit.factor * value), unit.unit);
}

std::string verdict_of(const RecordedStage& record) {
  if (record.evaluated.empty()) return "not evaluated";
  switch (worst_verdict(record.evaluated)) {
    case StageVerdict::passes:
      return "passes";
    case StageVerdict::outside:
      return "OUTSIDE its bracket: find the cause before the next stage";
    case StageVerdict::abort:
      break;
  }
  return "ABORT: back to the previous stage";
}

std::string estimate(const design::PlantEstimate& value, double unit, const char* form) {
  const auto text = [&](double number) { return fmt::format(fmt::runtime(form), number / unit); };
  return fmt::format("{} ({} to {})", text(value.mean), text(value.lower), text(value.upper));
}

// A fault and the stage that shows it.
std::vector<std::string> fault_row(const CommissionReport& report,
                                   const design::FaultTrial& trial) {
  if (!trial.detected) return {trial.fault, "none", "within the brackets of every stage"};
  const auto& stage = report.sheets[*trial.detected].stage;
  std::string shows = "unstable";
  if (trial.evaluation.worst) {
    const auto interval =
        pass_interval(*trial.evaluation.worst, stage, report.options.rms_allowance);
    const QuantityUnit unit = unit_of(*trial.evaluation.worst, report.units);
    shows = fmt::format("{} {}, expected {} to {}{}", to_string(*trial.evaluation.worst),
                        in_units(report, *trial.evaluation.worst, trial.measured),
                        checked_number(unit.factor * interval.lower),
                        checked_number(unit.factor * interval.upper),
                        trial.evaluation.verdict == StageVerdict::abort ? ": abort" : "");
  }
  return {trial.fault, fmt::format("{} {}", *trial.detected + 1, stage_name(stage)), shows};
}

}  // namespace

std::string stage_name(const design::CommissioningStage& stage) {
  const auto kind = to_string(stage.kind);
  return stage.steps == 1 ? std::string(kind)
                          : fmt::format("{}, {} of {}", kind, stage.step, stage.steps);
}

std::string command_in_words(const CommissionReport& report, const StageSheet& sheet) {
  const double sky = report.gear_ratio * millidegree;
  if (sheet.stage.controller.feedforward) {
    return fmt::format("move faster by {:.3g} mdeg/s within {:.3g} s, steady, and back",
                       report.move.rate / sky, report.move.rate / report.move.acceleration);
  }
  const bool open = sheet.stage.controller.position_open;
  return fmt::format("step of the {} command, {:.3g} mdeg{} at the sky", open ? "rate" : "position",
                     sheet.step / millidegree, open ? "/s" : "");
}

std::string motion_in_words(const CommissionReport& report, const StageSheet& sheet) {
  if (!sheet.experiment) return "";
  const double rate = sheet.experiment->base_rate / (report.gear_ratio * millidegree);
  return fmt::format(
      "Make it on a steady motion of {:.2g} mdeg/s{}. Still air: 100 s of that motion.", rate,
      sheet.stage.controller.feedforward
          ? std::string()
          : fmt::format(", up and down, each step {:.2g} s", sheet.experiment->step_time));
}

std::vector<std::string> about_records(const CommissionReport& report) {
  std::vector<std::string> sentences;
  for (const RecordedStage& record : report.records) {
    std::string text =
        fmt::format("Stage {} ({}), {}: {}", record.stage + 1,
                    stage_name(report.sheets[record.stage].stage), record.file, verdict_of(record));
    for (const auto& one : record.evaluated) {
      if (one.verdict == StageVerdict::passes) continue;
      const QuantityUnit unit = unit_of(one.measured.quantity, report.units);
      text += fmt::format("; {} {}, expected {} to {}", to_string(one.measured.quantity),
                          in_units(report, one.measured.quantity, one.measured.value),
                          checked_number(unit.factor * one.expected.lower),
                          checked_number(unit.factor * one.expected.upper));
    }
    sentences.push_back(text + ".");
  }
  if (!report.update) return sentences;
  const design::PlantUpdate& update = *report.update;
  if (!update.explained) {
    std::vector<std::string> faults;
    for (const auto& fault : update.faults) faults.push_back(fault.fault);
    constexpr std::size_t most = 3;
    if (faults.size() > most) faults.resize(most);
    sentences.push_back(
        faults.empty()
            ? "No plant of the uncertainty set responds like this, nor does one of the usual "
              "faults: check scales, signs and units of the records and the gains loaded."
            : fmt::format("No plant of the uncertainty set responds like this. What explains it "
                          "better, the best first: {}.",
                          fmt::join(faults, "; ")));
    return sentences;
  }
  const double sky = report.gear_ratio * millidegree;
  if (update.effective < design::fewest_effective_plants) {
    sentences.push_back(
        fmt::format("As few as {:.0f} of {} plants of the uncertainty set respond like this: their "
                    "intervals are "
                    "rough.",
                    update.effective, update.plants));
  }
  sentences.push_back(fmt::format(
      "By the records the antenna will end at {} mdeg boresight rms in the design wind (linear), "
      "{} before them.",
      estimate(update.final_rms_after, sky, "{:.3f}"),
      estimate(update.final_rms_before, sky, "{:.3f}")));
  return sentences;
}

std::vector<std::string> about_trials(const CommissionReport& report) {
  std::vector<std::string> sentences;
  if (const auto& trials = report.trials; !trials.stages.empty()) {
    sentences.push_back(fmt::format(
        "On {} of {} fresh plants of the uncertainty set every stage is stable. {:.1f} % pass all "
        "checks of all stages; a stage aborts on {:.2f} % (false alarms).",
        trials.stable, trials.plants, percentage(trials.passing, trials.plants),
        percentage(trials.aborted, trials.plants)));
  }
  if (!report.faults.empty()) {
    const auto detected = std::ranges::count_if(
        report.faults, [](const design::FaultTrial& trial) { return trial.detected.has_value(); });
    sentences.push_back(
        fmt::format("The stages detect {} of {} usual faults of scale, sign and build.", detected,
                    report.faults.size()));
  }
  return sentences;
}

Document trials_part(const CommissionReport& report) {
  Document text;
  if (!report.trials.stages.empty()) {
    Rows rows{{"stage", "", "stable %", "in brackets %", "aborts %", "most often outside", "%"}};
    for (std::size_t i = 0; i < report.trials.stages.size(); ++i) {
      const auto& trial = report.trials.stages[i];
      rows.push_back({fmt::format("{}", i + 1), stage_name(report.sheets[i].stage),
                      fmt::format("{:.2f}", percentage(trial.stable, trial.plants)),
                      fmt::format("{:.2f}", percentage(trial.passing, trial.plants)),
                      fmt::format("{:.2f}", percentage(trial.aborted, trial.plants)),
                      trial.worst ? std::string(to_string(*trial.worst)) : "-",
                      fmt::format("{:.2f}", percentage(trial.worst_outside, trial.plants))});
    }
    text += heading(fmt::format("Stages on {} fresh plants", report.trials.plants));
    text += essential(table(rows, "rlrrrl"));
  }
  if (!report.faults.empty()) {
    Rows rows{{"fault", "detected at stage", "which shows"}};
    for (const auto& trial : report.faults) rows.push_back(fault_row(report, trial));
    text += heading("Faults that the stages detect");
    text += table(rows, "lll");
    text += wrapped("Each fault alone, on the nominal antenna; later stages are not run.", "  ");
  }
  return text;
}

Document records_part(const CommissionReport& report) {
  if (report.records.empty()) return {};
  Document text = heading("Records of stages");
  for (const RecordedStage& record : report.records) {
    Rows rows{{fmt::format("stage {}", record.stage + 1), "unit", "measured", "+-", "from", "to",
               "abort above", "verdict"}};
    for (const auto& one : record.evaluated) {
      const auto [unit, factor] = unit_of(one.measured.quantity, report.units);
      rows.push_back({std::string(to_string(one.measured.quantity)), unit,
                      checked_number(factor * one.measured.value),
                      checked_number(factor * one.measured.uncertainty),
                      checked_number(factor * one.expected.lower),
                      checked_number(factor * one.expected.upper),
                      one.abort ? checked_number(factor * *one.abort) : "-",
                      std::string(to_string(one.verdict))});
    }
    text += essential(table(rows, "llrrrrrl"));
    for (const auto& remark : record.remarks) text += wrapped(remark, "  ");
  }
  if (!report.update) return text;
  const design::PlantUpdate& update = *report.update;
  text += wrapped(
      fmt::format("+-: standard uncertainty; two of them count for the stage. {} quantities on {} "
                  "plants: as many as {:.0f} equally likely ones are left; mismatch of the best "
                  "{:.1f} (chi-squared).",
                  update.quantities, update.plants, update.effective, update.mismatch),
      "  ");
  if (update.explained) {
    Rows rows{{"input (factor on the case's)", "before", "after"}};
    for (const auto& input : update.inputs) {
      rows.push_back({std::string(to_string(input.input)), estimate(input.before, 1.0, "{:.3f}"),
                      estimate(input.after, 1.0, "{:.3f}")});
    }
    text += essential(table(rows, "lll"));
    text += wrapped("Mean and 95 % interval; friction slope in N.m.s/rad.", "  ");
  }
  return text;
}

}  // namespace boresight::app
