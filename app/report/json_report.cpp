#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/report/audit_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/identification_description.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/linear_models_description.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/app/report/tune_description.hpp>
#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/description/pointing_limit_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>

namespace boresight::app {

std::string to_json(const Report& report) {
  Json json{{"program", "boresight"}, {"version", BORESIGHT_VERSION}, {"command", report.command}};
  json.update(json_by(
      [&](io::Visitor& v) { describe_case(v, report.case_path, report.title, report.axis); }));
  json["seed"] = report.seed;
  json["interrupted"] = report.interrupted;
  if (report.campaign) json["campaign"] = json_of(*report.campaign);
  if (report.identification) json["identification"] = json_of(*report.identification);
  if (report.audit) json["audit"] = json_of(*report.audit);
  if (report.plant) json["plant"] = json_of(*report.plant);
  if (report.tuning) json["tuning"] = json_of(*report.tuning);
  if (report.measured) json["measured_tuning"] = json_of(*report.measured);
  if (report.tuned) json["tuned"] = json_of(*report.tuned);
  if (report.time_domain) json["time_domain"] = json_of(*report.time_domain);
  if (report.limit) json["limit"] = json_of(*report.limit);
  if (!report.choices.empty()) {
    json.update(json_by([&](io::Visitor& v) { describe_choices(v, report.choices); }));
  }
  if (report.matching) {
    json.update(json_by([&](io::Visitor& v) { describe_matching(v, *report.matching); }));
  }
  if (report.matched) json["matched"] = json_of(*report.matched);
  if (report.evaluated) json["evaluated"] = evaluate_json(*report.evaluated);
  if (const auto models = linear_models(report)) json["linear_models"] = json_of(*models);
  json.update(json_by([&](io::Visitor& v) { describe_assumed(v, report.assumed); }));
  json["conclusions"] = report.conclusions;
  if (!report.figures.empty()) json["figures"] = figures_json(report.figures);
  return json.dump(2) + "\n";
}

}  // namespace boresight::app
