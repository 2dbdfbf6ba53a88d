#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using design::DepartingForm;
using design::DerivedQuantity;
using design::Finding;
using design::FindingKind;

constexpr double change_that_matters = 1e-3;
constexpr double change_worth_telling = 1e-5;

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

void append_finding(Document& page, const Finding& finding, std::size_t number) {
  page += wrapped(fmt::format("{:2}. {}: {}", number, finding.id, finding.description), "", "    ");
  page += wrapped(finding.source, "    ", "  ");
  for (const DepartingForm& form : finding.forms) {
    page += wrapped(fmt::format("'{}' would be '{}' ({})", form.text, form.would_be_text,
                                percent(form.relative_error())),
                    "    ", "  ");
  }
  for (const std::string& explanation : finding.explanations) {
    page += wrapped(followed_by(explanation), "    ", "  ");
  }
  for (const std::string& evidence : finding.evidence) page += wrapped(evidence, "    ", "  ");
  std::vector<std::string> moved;
  for (const DerivedQuantity& derived_quantity : finding.derived_quantities) {
    if (std::abs(derived_quantity.relative_change()) < change_worth_telling) continue;
    moved.push_back(fmt::format("{} {:.4g} for {:.4g} ({})", derived_quantity.id,
                                derived_quantity.as_printed, derived_quantity.as_corrected,
                                percent(derived_quantity.relative_change())));
  }
  if (!moved.empty())
    page += wrapped(fmt::format("changes {}", fmt::join(moved, ", ")), "    ", "  ");
}

void append_group(Document& page, const AuditReport& report, std::string_view title,
                  FindingKind kind, bool within_rounding, std::size_t& number) {
  bool first = true;
  for (const Finding& finding : report.findings) {
    if (finding.kind != kind || finding.within_parents_rounding != within_rounding) continue;
    if (first) {
      page += subheading(title, "") + "\n";
    }
    first = false;
    append_finding(page, finding, ++number);
  }
}

double largest_change(const Finding& finding) {
  return finding.derived_quantities.empty()
             ? 0.0
             : std::abs(finding.derived_quantities.front().relative_change());
}

bool follows_from_other_column(const Finding& finding) {
  return std::any_of(finding.explanations.begin(), finding.explanations.end(),
                     [](const std::string& explanation) {
                       return explanation.ends_with("from the other column");
                     });
}

// Of the printed numbers that can be compared, how many places do not follow.
std::string compared_numbers(const AuditReport& report) {
  if (!report.findings.empty()) {
    return fmt::format(
        "Of {} stated {} compared, {} inconsistent", report.checked,
        report.checked == 1 ? "value" : "values",
        report.findings.size() == 1 ? "1 is" : fmt::format("{} are", report.findings.size()));
  }
  if (report.checked == 0) {
    return "The case states no derived numbers to compare ([[stated]])";
  }
  constexpr std::size_t named = 6;
  const std::vector<std::string> first(
      report.compared.begin(), report.compared.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                             named, report.compared.size())));
  return fmt::format(
      "{} ({}{})",
      report.checked == 1
          ? "The one stated derived value is consistent"
          : fmt::format("All {} stated derived values are consistent", report.checked),
      fmt::join(first, ", "), report.compared.size() > named ? ", ..." : "");
}

// Which of the printed numbers that do not follow matter; a failed physical check moves no number.
std::string moved_results(const AuditReport& report) {
  if (report.findings.empty()) return "";
  std::vector<const Finding*> matter;
  for (const Finding& finding : report.findings) {
    // Consistent in itself where it follows from another column: correct that one.
    if (largest_change(finding) > change_that_matters && !follows_from_other_column(finding)) {
      matter.push_back(&finding);
    }
  }
  if (matter.empty()) return " None of them changes a headline result by more than 0.1 %.";
  std::stable_sort(matter.begin(), matter.end(), [](const Finding* a, const Finding* b) {
    return largest_change(*a) > largest_change(*b);
  });
  std::vector<std::string> moved;
  std::set<std::pair<std::string, std::string>> named;  // a number may fail several comparisons
  for (const Finding* finding : matter) {
    const std::string& number = finding->forms.front().text;
    if (!named.emplace(finding->id, number).second) continue;
    const DerivedQuantity& maximum = finding->derived_quantities.front();
    moved.push_back(fmt::format("{} '{}' ({} {})", finding->id, number, maximum.id,
                                percent(maximum.relative_change())));
  }
  return fmt::format(" Correct those that change a headline result by more than 0.1 %: {}.",
                     fmt::join(moved, "; "));
}

}  // namespace

std::string audit_summary(const AuditReport& report) {
  const std::string compared = compared_numbers(report);
  if (report.findings.empty() && report.implausible.empty()) {
    return fmt::format("{}, and nothing in {} is physically implausible.", compared,
                       report.checked == 0 ? "it" : "the case");
  }
  return fmt::format("{}; {}.{}", compared, failing_checks(report.implausible),
                     moved_results(report));
}

Document document_of(const AuditReport& report) {
  Document page = heading(fmt::format("Audit of {}", report.title));
  std::size_t number = 0;
  append_group(page, report, "Columns that disagree beyond their rounding", FindingKind::conversion,
               false, number);
  append_group(page, report, "Derived values inconsistent beyond all stated rounding",
               FindingKind::derivation, false, number);
  append_group(
      page, report,
      "Derived values inconsistent in their digits, but within the rounding of their inputs",
      FindingKind::derivation, true, number);
  append_group(page, report, "Inputs stated again with another value", FindingKind::restatement,
               false, number);
  if (!report.implausible.empty()) page += subheading("Physically implausible", "") + "\n";
  for (const Implausibility& implausible : report.implausible) {
    page += wrapped(fmt::format("{:2}. {}, {}: {}", ++number, implausible.check, implausible.id,
                                implausible.reasoning),
                    "", "    ");
  }
  if (!report.remarks.empty()) page += subheading("Remarks by the case's writer", "") + "\n";
  for (const Remark& remark : report.remarks) {
    page += wrapped(fmt::format("{:2}. {}: {}", ++number, remark.place, remark.text), "", "    ");
  }
  page += subheading("Summary", "") + "\n";
  page += wrapped("Changes are computed from the values as first stated.", "");
  page += essential(wrapped(audit_summary(report), ""));
  return page;
}

}  // namespace boresight::app
