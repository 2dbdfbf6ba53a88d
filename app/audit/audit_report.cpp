#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/audit/case_graph.hpp>

namespace boresight::app {
namespace {

using identification::Consequence;
using identification::DepartingForm;
using identification::Finding;
using identification::FindingKind;

constexpr std::size_t width = 100;
constexpr double change_that_matters = 1e-3;
constexpr double change_worth_telling = 1e-5;

/// Appends text broken at blanks; the first line starts at `first`, the others at `rest` columns.
void append_wrapped(std::string& page, const std::string& text, std::size_t first,
                    std::size_t rest) {
  std::size_t column = first;
  page.append(first, ' ');
  bool at_start = true;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (!at_start && column + 1 + length > width) {
      page += '\n';
      page.append(rest, ' ');
      column = rest;
      at_start = true;
    }
    if (!at_start) {
      page += ' ';
      ++column;
    }
    page.append(text, begin, length);
    column += length;
    at_start = false;
    begin = end + 1;
  }
  page += '\n';
}

std::string percent(double relative) {
  if (std::abs(relative) > 10.0) return fmt::format("{:.3g} times", relative + 1.0);
  return fmt::format("{:+.3g} %", 100.0 * relative);
}

// "'1.31 kg.m2' as ..." names the form it is about; otherwise there is only one.
std::string followed_by(const std::string& explanation) {
  const std::size_t end = explanation[0] == '\'' ? explanation.find("' ") : std::string::npos;
  if (end == std::string::npos) return "would follow " + explanation;
  return explanation.substr(0, end + 1) + " would follow" + explanation.substr(end + 1);
}

void append_finding(std::string& page, const Finding& finding, std::size_t number) {
  append_wrapped(page, fmt::format("{:2}. {}: {}", number, finding.id, finding.description), 0, 4);
  append_wrapped(page, finding.source, 4, 6);
  for (const DepartingForm& form : finding.forms) {
    append_wrapped(page,
                   fmt::format("'{}' would be '{}' ({})", form.text, form.would_be_text,
                               percent(form.relative_error())),
                   4, 6);
  }
  for (const std::string& explanation : finding.explanations) {
    append_wrapped(page, followed_by(explanation), 4, 6);
  }
  for (const std::string& evidence : finding.evidence) append_wrapped(page, evidence, 4, 6);
  std::vector<std::string> moved;
  for (const Consequence& consequence : finding.consequences) {
    if (std::abs(consequence.relative_change()) < change_worth_telling) continue;
    moved.push_back(fmt::format("{} {:.4g} for {:.4g} ({})", consequence.id, consequence.as_printed,
                                consequence.as_corrected, percent(consequence.relative_change())));
  }
  if (!moved.empty()) append_wrapped(page, fmt::format("moves {}", fmt::join(moved, ", ")), 4, 6);
}

void append_group(std::string& page, const AuditReport& report, std::string_view title,
                  FindingKind kind, bool within_rounding, std::size_t& number) {
  bool first = true;
  for (const Finding& finding : report.findings) {
    if (finding.kind != kind || finding.within_parents_rounding != within_rounding) continue;
    if (first) {
      page += '\n';
      append_wrapped(page, std::string(title), 0, 0);
      page += '\n';
    }
    first = false;
    append_finding(page, finding, ++number);
  }
}

double largest_change(const Finding& finding) {
  return finding.consequences.empty() ? 0.0
                                      : std::abs(finding.consequences.front().relative_change());
}

std::string summary(const AuditReport& report) {
  std::vector<const Finding*> matter;
  for (const Finding& finding : report.findings) {
    if (largest_change(finding) > change_that_matters) matter.push_back(&finding);
  }
  std::stable_sort(matter.begin(), matter.end(), [](const Finding* a, const Finding* b) {
    return largest_change(*a) > largest_change(*b);
  });
  if (report.findings.empty() && report.implausible.empty()) {
    return fmt::format(
        "All {} printed numbers follow from each other, and nothing in them is "
        "physically implausible.",
        report.checked);
  }
  std::string text = fmt::format(
      "Of {} printed numbers compared, {} places do not follow; {} physical checks fail.",
      report.checked, report.findings.size(), report.implausible.size());
  if (matter.empty()) return text + " None of them moves a headline result by more than 0.1 %.";
  std::vector<std::string> moved;
  std::set<std::pair<std::string, std::string>> named;  // a number may fail several comparisons
  for (const Finding* finding : matter) {
    const std::string& number = finding->forms.front().text;
    if (!named.emplace(finding->id, number).second) continue;
    const Consequence& most = finding->consequences.front();
    moved.push_back(fmt::format("{} '{}' ({} {})", finding->id, number, most.id,
                                percent(most.relative_change())));
  }
  return text + fmt::format(
                    " Those that move a headline result by more than 0.1 % are {}; the "
                    "others can stand without harm.",
                    fmt::join(moved, "; "));
}

}  // namespace

AuditReport audit(const Case& antenna) {
  const identification::AuditGraph graph = case_graph(antenna);
  AuditReport report;
  report.title = antenna.title;
  report.findings = identification::find_misprints(graph);
  report.implausible = implausibilities(antenna, graph);
  report.remarks = antenna.remarks;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const auto& statements = graph.node(i).statements;
    for (std::size_t s = 0; s < statements.size(); ++s) {
      const std::size_t forms = statements[s].forms.size();
      // The first print of an input has nothing to be compared with but its other columns.
      report.checked += graph.is_input(i) && s == 0 ? forms - 1 : forms;
    }
  }
  return report;
}

std::string to_text(const AuditReport& report) {
  std::string page = fmt::format("Audit of {}\n", report.title);
  std::size_t number = 0;
  append_group(page, report, "Columns that disagree beyond their rounding", FindingKind::conversion,
               false, number);
  append_group(page, report, "Derived numbers that do not follow beyond all printed rounding",
               FindingKind::derivation, false, number);
  append_group(page, report,
               "Derived numbers whose own digits do not follow, though the rounding of what they "
               "come from could hide it",
               FindingKind::derivation, true, number);
  append_group(page, report, "Inputs printed again with another value", FindingKind::restatement,
               false, number);
  if (!report.implausible.empty()) page += "\nPhysically implausible\n\n";
  for (const Implausibility& implausible : report.implausible) {
    append_wrapped(page,
                   fmt::format("{:2}. {}, {}: {}", ++number, implausible.check, implausible.id,
                               implausible.reasoning),
                   0, 4);
  }
  if (!report.remarks.empty()) page += "\nRemarks by the case's writer\n\n";
  for (const RemarkEntry& remark : report.remarks) {
    append_wrapped(page, fmt::format("{:2}. {}: {}", ++number, remark.place, remark.text), 0, 4);
  }
  page += "\nSummary\n\n";
  append_wrapped(page, summary(report), 0, 0);
  return page;
}

}  // namespace boresight::app
