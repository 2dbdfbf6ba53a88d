#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/text_layout.hpp>
#include <boresight/app/report/text_limit.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

// Mass properties alone are among the campaign's methods already.
bool rests_on_tests(const IdentificationSection& section) {
  const auto& methods = section.inertia.methods;
  return std::any_of(methods.begin(), methods.end(), [](const auto& method) {
    return method.kind != identification::MethodKind::mass_properties;
  });
}

}  // namespace

std::string assumed_text(const std::vector<Quantity>& assumed) {
  std::string text = heading("Assumed inputs");
  if (assumed.empty()) return text + "  none\n";
  std::vector<std::vector<std::string>> rows{{"key", "value", "assumed", "because"}};
  for (const auto& quantity : assumed) {
    const bool value = quantity.basis == Basis::assumed;
    const std::string& source = value ? quantity.source : quantity.uncertainty_source;
    rows.push_back({quantity.key, quantity.text, value ? "value" : "uncertainty", source});
  }
  return text + table(rows, "llll");
}

std::string to_text(const Report& report) {
  std::string text =
      fmt::format("Boresight {} {}: {} ({} axis)\ncase {}, seed {}\n", BORESIGHT_VERSION,
                  report.command, report.title, report.axis, report.case_path, report.seed);
  if (report.interrupted) text += "INTERRUPTED: what follows is whole, the rest is missing.\n";
  if (report.campaign) text += to_text(*report.campaign);
  if (report.identification && (!report.campaign || rests_on_tests(*report.identification))) {
    text += to_text(*report.identification);
  }
  if (report.audit && report.command == "audit") text += to_text(*report.audit);
  if (report.audit && report.command != "audit") {
    text += heading("Audit of the case's own numbers");
    text += wrapped(fmt::format("{} `boresight audit {}` lists each.", audit_summary(*report.audit),
                                report.case_path),
                    "  ");
  }
  if (report.plant) text += to_text(*report.plant);
  if (report.tuning) text += to_text(*report.tuning);
  if (report.measured) text += to_text(*report.measured);
  if (report.tuned) text += to_text(*report.tuned);
  if (report.limit) text += to_text(*report.limit);
  if (report.time_domain) text += to_text(*report.time_domain);
  if (!report.choices.empty()) text += choices_text(report.choices);
  if (report.matching) text += to_text(*report.matching);
  if (report.matched) text += to_text(*report.matched);
  if (report.evaluated) text += to_text(*report.evaluated);
  if (report.command != "audit") text += assumed_text(report.assumed);
  if (!report.conclusions.empty()) {
    text += heading("What the numbers mean");
    for (const auto& sentence : report.conclusions) text += wrapped(sentence, "  ") + "\n";
  }
  return text;
}

}  // namespace boresight::app
