#include <cmath>

#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/audit_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/identification_description.hpp>
#include <boresight/app/report/json_design.hpp>
#include <boresight/app/report/json_linear_models.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/tune_description.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/description/pointing_limit_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

Json tuning_json(const TuningSection& section) {
  const auto gusts = plant::site_gusts(section.wind_site);
  Json json{{"design_wind_speed_m_per_s", section.design_speed},
            {"wind_model", plant::to_string(section.wind_model)},
            {"gust_spectrum", plant::to_string(gusts.kind)},
            {"turbulence_intensity_1",
             std::sqrt(plant::gust_variance(gusts, section.design_speed)) / section.design_speed},
            {"wind_torque_coefficient_1", section.wind_site.torque_coefficient},
            {"tuned_for", to_string(section.tuned_for)},
            {"design", design_json(section.design)},
            {"seeds_within_1_percent", section.seeds_within_1_percent},
            {"encoder_held_rms_mdeg", number(section.encoder_held_rms / millidegree)},
            {"supply_wind_speed_m_per_s", number(section.supply_wind_speed)},
            {"static_bending_mdeg", number(section.static_bending / millidegree)}};
  Json goals = Json::array();
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    goals.push_back({{"loop_break", control::to_string(control::loop_breaks[b])},
                     {"sensitivity_peak_1", section.goals.sensitivity_peak[b]}});
  }
  if (section.wind_mast) json["wind_mast"] = mast_json(*section.wind_mast);
  json["sensitivity_goals"] = std::move(goals);
  json["valve_effort_goal_rad_per_s"] = section.goals.valve_effort;
  json["seeds"] = Json::array();
  for (const auto& seed : section.seeds) {
    json["seeds"].push_back({{"seed", seed.seed},
                             {"beam_rms_mdeg", number(seed.beam_rms / millidegree)},
                             {"verified", seed.verified}});
  }
  json["wind_models"] = Json::array();
  for (const auto& alternative : section.wind_alternatives) {
    Json limits = Json::array();
    for (const double limit : alternative.speed_limits) limits.push_back(number(limit));
    json["wind_models"].push_back({{"model", plant::to_string(alternative.model)},
                                   {"beam_rms_mdeg", number(alternative.beam_rms / millidegree)},
                                   {"budget_wind_speed_limits_m_per_s", std::move(limits)}});
  }
  json["bands"] = Json::array();
  for (const auto& loss : section.losses) {
    json["bands"].push_back({{"name", loss.band.name},
                             {"frequency_Hz", loss.band.frequency},
                             {"beamwidth_mdeg", loss.band.beamwidth / millidegree},
                             {"mean_loss_two_axes_dB", number(loss.mean_loss_db)},
                             {"static_bending_loss_dB", number(loss.static_bending_db)}});
  }
  json["present"] = Json::array();
  for (const auto& [structure, design] : section.present) {
    json["present"].push_back({{"structure", structure},
                               {"stable", design.tuning.status != design::TuningStatus::unstable},
                               {"goals_met", design.verification.passed},
                               {"beam_rms_mdeg", number(design.beam_rms / millidegree)}});
  }
  json["ensemble"] = section.ensemble ? ensemble_json(*section.ensemble) : Json(nullptr);
  json["input_effects"] = Json::array();
  for (const auto& effect : section.input_effects) {
    json["input_effects"].push_back(
        {{"key", effect.quantity.key},
         {"basis", to_string(effect.quantity.basis)},
         {"value_si", effect.quantity.value},
         {"moved_by_si", effect.moved_by},
         {"uncertainty_unstated", effect.unstated},
         {"lower_beam_rms_mdeg", number(effect.low_rms / millidegree)},
         {"higher_beam_rms_mdeg", number(effect.high_rms / millidegree)}});
  }
  json["budgets"] = Json::array();
  for (const auto& result : section.budgets) {
    json["budgets"].push_back(
        {{"name", result.budget.name},
         {"band", result.budget.band},
         {"convention", result.budget.convention},
         {"rms_mdeg", result.budget.rms / millidegree},
         {"wind_speed_limit_m_per_s", number(result.wind_speed_limit)},
         {"plants_met", result.plants_met ? Json(*result.plants_met) : Json(nullptr)},
         {"share_of_time_1",
          share_of_time_json(section.climate, reached_wind_speed(section, result))}});
  }
  return json;
}

}  // namespace

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
  if (report.tuning) json["tuning"] = tuning_json(*report.tuning);
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
  if (const auto models = linear_models(report)) {
    json["linear_models"] = linear_models_json(*models);
  }
  json.update(json_by([&](io::Visitor& v) { describe_assumed(v, report.assumed); }));
  json["conclusions"] = report.conclusions;
  if (!report.figures.empty()) json["figures"] = figures_json(report.figures);
  return json.dump(2) + "\n";
}

}  // namespace boresight::app
