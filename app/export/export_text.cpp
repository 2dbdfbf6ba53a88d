#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/export/export_report.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/control/program/program.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string of_states(const control::LoopStructure& structure) {
  return structure.state_space() != nullptr ? fmt::format(", order {}", structure.parts())
                                            : std::string();
}

std::vector<std::string> decision(const ExportReport& report) {
  const auto& exported = report.exported;
  std::vector<std::string> sentences{
      fmt::format("{}{} ({}), every {:g} s, as simulated: {} files in {}.", report.structure,
                  of_states(exported.controller.structure), report.source, exported.sample_time,
                  report.files.size(), report.folder)};
  std::vector<std::string> defaults;
  for (const auto& signal : report.signals) {
    if (!signal.stated) defaults.push_back(signal.signal);
  }
  if (!defaults.empty()) {
    sentences.push_back(
        fmt::format("Before use, state the computer's signals in [computer] of the case; defaults "
                    "stand for: {}.",
                    fmt::join(defaults, ", ")));
  }
  if (!exported.achievable_limits) {
    const auto& limits = exported.options.limits;
    sentences.push_back(fmt::format(
        "The commanded motion is limited to what the drive achieves: {:.3g} deg/s of {:.3g} and "
        "{:.2g} deg/s2 of {:.2g}.",
        limits.rate / degree, exported.wanted.rate / degree, limits.acceleration / degree,
        exported.wanted.acceleration / degree));
  }
  return sentences;
}

Document signals(const ExportReport& report) {
  Rows rows{{"signal", "scale", "by"}};
  for (const auto& signal : report.signals) {
    rows.push_back({signal.signal, signal.scale, signal.stated ? "case" : "DEFAULT"});
  }
  return heading("Signals of the antenna's computer") + essential(table(std::move(rows), "lll"));
}

Document gains(const ExportReport& report) {
  Rows rows{{"gain", "", "value", "unit"}};
  for (const auto& row : io::gain_rows(report.exported.controller)) {
    rows.push_back({row.symbol, row.name, fmt::format("{:.6g}", row.value), row.unit});
  }
  if (rows.size() == 1) return {};
  return heading("Gains, SI at the motor shaft") + essential(table(std::move(rows), "llrl"));
}

std::string unit_text(const std::string& unit) {
  return unit.empty() ? "1" : unit;
}

Document feedforward_and_limits(const ExportReport& report) {
  const auto& program = report.exported.program;
  const auto is_shown = [](const control::program::Variable& variable) {
    return variable.name.starts_with("feedforward_") || variable.name.starts_with("friction_") ||
           variable.name.ends_with("_limit") || variable.name == "anti_windup" ||
           variable.name == "supply_torque" || variable.name.starts_with("largest_");
  };
  Rows rows{{"parameter", "value", "unit", ""}};
  for (const auto& variable : program.variables) {
    if (variable.role != control::program::Role::parameter || !is_shown(variable)) continue;
    rows.push_back({variable.name, fmt::format("{:.6g}", variable.initial),
                    unit_text(variable.unit), variable.comment});
  }
  std::string note = fmt::format("Feedforward of friction: {:.0f} % of the antenna's curve.",
                                 100.0 * report.exported.friction_feedforward);
  const bool integrates = std::ranges::any_of(
      program.variables, [](const auto& variable) { return variable.name == "anti_windup"; });
  if (report.exported.controller.structure.state_space() != nullptr) {
    note += " A state space has no anti-windup.";
  } else if (!integrates) {
    note += " No anti-windup: no loop integrates.";
  }
  return heading("Feedforward, anti-windup and limits") + table(std::move(rows), "lrll") +
         wrapped(note, "  ");
}

Document checks(const ExportReport& report) {
  Document text = heading("Check before loading");
  if (report.with_c) {
    text += essential(verbatim(
        fmt::format("  cc -std=c99 -O2 -ffp-contract=off -o {0}_controller_test {0}_controller.c "
                    "{0}_controller_test.c -lm\n  ./{0}_controller_test vectors\n",
                    report.prefix)));
  }
  if (report.with_vectors) {
    text += essential(wrapped(
        "vectors/: inputs and expected outputs of 500 samples each, with tolerances in double and "
        "single precision.",
        "  "));
  }
  text += essential(wrapped(
      "On the antenna in standby: a small positive manual command raises tachometer and encoder "
      "counts, and a pressure difference against the brakes. Correct a sign that differs before "
      "the "
      "loop is closed; then the stages of `boresight commission`.",
      "  "));
  text += wrapped(fmt::format("Operations per step: at most {} floating-point.",
                              control::program::operation_count(report.exported.program)),
                  "  ");
  return text;
}

Document files(const ExportReport& report) {
  std::string list;
  for (const auto& file : report.files) list += fmt::format("  {}\n", file);
  return heading(fmt::format("Files in {}", report.folder)) + essential(verbatim(list));
}

}  // namespace

Document document_of(const ExportReport& report) {
  return report_title("export", report.title, words_beside(report.title, report.axis),
                      report.case_path, std::nullopt) +
         lead(decision(report)) + files(report) + signals(report) + gains(report) +
         feedforward_and_limits(report) + checks(report) + document_of(report.assumed);
}

}  // namespace boresight::app
