
#include <nlohmann/json.hpp>

#include <boresight/app/report/json_audit.hpp>
#include <boresight/app/report/json_number.hpp>

namespace boresight::app {
namespace {

Json finding_json(const design::Finding& finding) {
  Json forms = Json::array();
  for (const auto& form : finding.forms) {
    forms.push_back({{"printed_text", form.text},
                     {"printed_si", number(form.printed)},
                     {"would_be_text", form.would_be_text},
                     {"would_be_si", number(form.would_be)},
                     {"tolerance_si", number(form.tolerance)},
                     {"relative_error_1", number(form.relative_error())}});
  }
  Json consequences = Json::array();
  for (const auto& consequence : finding.consequences) {
    consequences.push_back({{"id", consequence.id},
                            {"unit", consequence.unit},
                            {"as_printed_si", number(consequence.as_printed)},
                            {"as_corrected_si", number(consequence.as_corrected)},
                            {"relative_change_1", number(consequence.relative_change())}});
  }
  return {{"kind", to_string(finding.kind)},
          {"id", finding.id},
          {"description", finding.description},
          {"unit", finding.unit},
          {"source", finding.source},
          {"forms", std::move(forms)},
          {"within_parents_rounding", finding.within_parents_rounding},
          {"explanations", finding.explanations},
          {"evidence", finding.evidence},
          {"consequences", std::move(consequences)}};
}

Json implausibility_json(const Implausibility& implausibility) {
  Json numbers = Json::array();
  for (const auto& named : implausibility.numbers) {
    numbers.push_back(
        {{"name", named.name}, {"value_si", number(named.value)}, {"unit", named.unit}});
  }
  return {{"check", implausibility.check},
          {"id", implausibility.id},
          {"reasoning", implausibility.reasoning},
          {"numbers", std::move(numbers)}};
}

}  // namespace

nlohmann::ordered_json audit_json(const AuditReport& report) {
  Json json{{"checked_numbers", report.checked},
            {"findings", Json::array()},
            {"implausible", Json::array()},
            {"remarks", Json::array()}};
  for (const auto& finding : report.findings) json["findings"].push_back(finding_json(finding));
  for (const auto& implausibility : report.implausible) {
    json["implausible"].push_back(implausibility_json(implausibility));
  }
  for (const auto& remark : report.remarks) {
    json["remarks"].push_back({{"place", remark.place}, {"text", remark.text}});
  }
  return json;
}

}  // namespace boresight::app
