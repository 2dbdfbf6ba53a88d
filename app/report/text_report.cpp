#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/app/report/text_limit.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

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

Document document_of(const std::vector<io::SupersededInput>& superseded) {
  Document text = heading("Inputs taken from the records");
  std::vector<std::vector<std::string>> rows{
      {"key", "unit", "stated", "records", "+-%", "was assumed"}};
  for (const auto& input : superseded) {
    const double fraction = 100.0 * numerics::normal_975 * input.standard_uncertainty;
    rows.push_back({input.key, input.unit, fmt::format("{:.4g}", input.stated_value),
                    fmt::format("{:.4g}", input.value),
                    fraction > 0.0 ? fmt::format("{:.2g}", fraction / std::abs(input.value)) : "-",
                    input.assumed ? "yes" : "no"});
  }
  return text + table(rows, "llrrrl") +
         wrapped("+-%: 95 % interval. All other inputs are those of the case.", "  ");
}

Document document_of(const std::vector<io::Quantity>& assumed) {
  Document text = heading("Assumed inputs");
  if (assumed.empty()) return text + "  none\n";
  std::vector<std::vector<std::string>> rows{{"key", "value", "assumed", "because"}};
  for (const auto& quantity : assumed) {
    const bool value = quantity.basis == io::Basis::assumed;
    const std::string& source = value ? quantity.source : quantity.uncertainty_source;
    rows.push_back({quantity.key, quantity.text, value ? "value" : "uncertainty", source});
  }
  return text + table(rows, "llll");
}

namespace {

Document opening_of(const Report& report) {
  Document text =
      report_title(report.command, report.title, words_beside(report.title, report.axis),
                   report.case_path, report.seed);
  if (report.interrupted)
    text += "INTERRUPTED: the sections below are complete, the rest is missing.\n";
  return text;
}

Document sections_of(const Report& report) {
  Document text;
  // Of a redesign the records are a part; `boresight identify` shows all of its tables.
  constexpr std::size_t methods = 8;
  if (report.campaign) {
    Document records = document_of(*report.campaign);
    text += report.tuning ? shortened(std::move(records), methods) : std::move(records);
  }
  if (report.identification && (!report.campaign || rests_on_tests(*report.identification))) {
    text += document_of(*report.identification);
  }
  if (report.audit && report.command == "audit") text += document_of(*report.audit);
  if (report.audit && report.command != "audit") {
    text += heading("Audit of the case's own numbers");
    text += wrapped(fmt::format("{} `boresight audit {}` lists each.", audit_summary(*report.audit),
                                report.case_path),
                    "  ");
    constexpr std::size_t few = 4;
    const auto& failing = report.audit->implausible;
    if (failing.size() <= few) {
      for (const auto& check : failing) text += wrapped(check.reasoning, "  ");
    }
  }
  if (report.plant) {
    Document plant = document_of(*report.plant);
    text += report.command == "model" ? essential(std::move(plant)) : std::move(plant);
  }
  if (report.tuning) text += document_of(*report.tuning);
  if (report.measured) text += document_of(*report.measured);
  if (report.tuned) text += document_of(*report.tuned);
  if (report.limit) text += document_of(*report.limit);
  if (report.state_space && report.time_domain) {
    text += document_of(*report.state_space, *report.time_domain);
  }
  if (report.time_domain) text += document_of(*report.time_domain);
  if (!report.interpretations.empty()) text += document_of(report.interpretations);
  if (report.matching) text += document_of(*report.matching);
  if (report.matched) text += document_of(*report.matched);
  if (report.evaluated) text += document_of(*report.evaluated);
  if (!report.superseded.empty()) text += document_of(report.superseded);
  if (report.command != "audit") text += document_of(report.assumed);
  if (!report.conclusions.empty()) {
    text += heading("What the numbers mean");
    // What an audit or the methods ask for next has no table; a result without a decision has only
    // these.
    const bool needed = report.command == "audit" || report.command == "identify" ||
                        (redesign_card(report).empty() && decision(report).empty());
    for (const auto& sentence : report.conclusions) {
      Document line = wrapped(sentence, "  ") + "\n";
      text += needed ? essential(std::move(line)) : std::move(line);
    }
  }
  return text;
}

}  // namespace

Document document_of(const Report& report) {
  const auto card = redesign_card(report);
  return opening_of(report) + (card.empty() ? lead(decision(report)) : document_of(card)) +
         sections_of(report);
}

std::string to_text(const Report& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
