#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_findings.hpp>
#include <boresight/app/commission/commission_sheets.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/figures/figure_csv.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/io/code/exported_files.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr const char* field = "________";

std::string heading_of(const CommissionReport& report, std::size_t i) {
  return fmt::format("Stage {} of {}: {}", i + 1, report.sheets.size(),
                     stage_name(report.sheets[i].stage));
}

Document sheet(const CommissionReport& report, std::size_t i) {
  const StageSheet& stage = report.sheets[i];
  Document text = heading(heading_of(report, i));
  text += wrapped(fmt::format("{} with {}; position loop {}.", report.title, report.structure,
                              stage.stage.controller.position_open ? "open" : "closed"),
                  "  ");
  std::vector<std::string> gains;
  for (const auto& gain : stage.gains) {
    gains.push_back(
        fmt::format("{} = {}{}", gain.symbol, gain.text, gain.changed ? " (changed)" : ""));
  }
  text += wrapped(fmt::format("Set: {}.", fmt::join(gains, "; ")), "  ");
  if (stage.checks.empty()) return text + wrapped(stage.reserve, "  ");
  text +=
      wrapped(fmt::format("Do: {}; then a record in still air{}", command_in_words(report, stage),
                          stage.experiment ? ". " + motion_in_words(report, stage)
                                           : " with the command at rest or in slow motion."),
              "  ");
  Rows rows{{"measure", "unit", "expected", "from", "to", "abort above", "measured", "passes"}};
  for (const auto& check : stage.checks) {
    rows.push_back({std::string(to_string(check.quantity)), check.unit,
                    checked_number(check.expected), checked_number(check.lower),
                    checked_number(check.upper),
                    check.abort_above ? checked_number(*check.abort_above) : "-", field, field});
  }
  text += table(rows, "ll");
  text += wrapped(stage.reserve, "  ");
  text += wrapped("To go back: " + stage.way_back, "  ");
  return text + table({{"result", "wind m/s", "elevation deg", "name", "initials", "date"},
                       {field, field, field, field, field, field}},
                      "llllll");
}

std::string sheets_csv(const CommissionReport& report) {
  std::string text =
      "stage,name,position_loop,command,quantity,unit,expected,lower,upper,abort_above,measured,"
      "passes,initials,date\n";
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const StageSheet& stage = report.sheets[i];
    for (const auto& check : stage.checks) {
      text +=
          fmt::format("{},{},{},{},{},{},{:.9g},{:.9g},{:.9g},{},,,,\n", i + 1,
                      csv_field(stage_name(stage.stage)),
                      stage.stage.controller.position_open ? "open" : "closed",
                      csv_field(command_in_words(report, stage) + (stage.experiment ? ". " : "") +
                                motion_in_words(report, stage)),
                      csv_field(std::string(to_string(check.quantity))), csv_field(check.unit),
                      check.expected, check.lower, check.upper,
                      check.abort_above ? fmt::format("{:.9g}", *check.abort_above) : "");
    }
  }
  return text;
}

}  // namespace

Page commission_sheets(const CommissionReport& report) {
  Page page;
  page.command = "commission";
  page.title = report.title;
  page.axis = words_beside(report.title, report.axis);
  page.seed = report.seed;
  page.decision = {fmt::format(
      "Sheets to fill in and sign: {} stages to {}. A stage passes when every value lies from "
      "\"from\" to \"to\". Go back above an abort limit, or on any ringing that does not decay; "
      "between the two find the cause first.",
      report.sheets.size(), report.structure)};
  for (std::size_t i = 0; i < report.sheets.size(); ++i) page.document += sheet(report, i);
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    if (auto figure = stage_bode_figure(report, i, heading_of(report, i))) {
      page.figures.push_back(*std::move(figure));
    }
  }
  return page;
}

std::vector<io::CodeFile> commission_files(const CommissionReport& report) {
  std::vector<io::CodeFile> files{{"sheets.csv", sheets_csv(report)}};
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    io::CodeFile file =
        io::controller_to_read(report.sheets[i].stage.controller.controller, report.structure);
    file.name = fmt::format("stage_{:02}_{}", i + 1, file.name);
    if (report.sheets[i].stage.controller.position_open) {
      file.content =
          "# The position loop is open in this stage: its gains do not act.\n" + file.content;
    }
    files.push_back(std::move(file));
  }
  return files;
}

}  // namespace boresight::app
