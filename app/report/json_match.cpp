#include <cmath>

#include <boresight/app/report/json_what_if.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::app {
namespace {

Json mdeg(double angle) {
  return number(angle / millidegree);
}

Json range_json(const FlatRange& range) {
  return {{"lowest_disks_1", number(range.lowest)}, {"highest_disks_1", number(range.highest)}};
}

Json point_json(const MatchPoint& point) {
  return {{"flywheel_disks_1", point.disks},
          {"label", text_or_null(point.label)},
          {"motor_inertia_kg_m2", point.motor_inertia},
          {"motor_to_load_ratio_1", point.motor_to_load_ratio},
          {"reflected_inertia_kg_m2", point.reflected_inertia},
          {"hydraulic_frequency_Hz", point.hydraulic.frequency},
          {"hydraulic_damping_ratio_1", point.hydraulic.damping_ratio},
          {"oil_mode", mode_json(point.oil_mode)},
          {"acceleration_mdeg_per_s2", mdeg(point.acceleration)},
          {"slew_time_s", number(point.slew_time)},
          {"rule_damping_ratio_1", point.two_mass_damping},
          {"acceleration_of_best_ratio_1", point.acceleration_of_best_ratio}};
}

Json margins_json(const MatchValue& value) {
  Json margins = Json::array();
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    margins.push_back(json_of(MatchMargins{control::loop_breaks.at(b), value.margins.at(b)}));
  }
  return margins;
}

Json time_json(const std::optional<MatchTimeDomain>& run) {
  if (!run) return nullptr;
  Json hunting = Json::array();
  for (const auto& one : run->hunting) {
    hunting.push_back(
        json_by([&](io::Visitor& v) { describe(v, one, io::LimitCycleDetail::study); }));
  }
  Json reversal = nullptr;
  if (run->reversal) {
    reversal = {{"status", design::to_string(run->reversal->status)},
                {"encoder_error_mdeg", mdeg(run->reversal->encoder_error)},
                {"beam_error_mdeg", mdeg(run->reversal->beam_error)},
                {"encoder_error_without_friction_mdeg",
                 mdeg(run->reversal->encoder_error_without_friction)}};
  }
  return {{"hunting", std::move(hunting)}, {"reversal", std::move(reversal)}};
}

Json law_json(const MatchSeries& series, std::size_t i) {
  const design::MatchedLaw& law = series.curve.laws[i];
  const MatchValue& value = series.values[i];
  static constexpr std::array status{"optimal", "infeasible", "unstable"};
  Json result = {
      {"status", law.searched ? status.at(static_cast<std::size_t>(law.status)) : "not run"},
      {"starts", law.starts},
      {"starts_at_optimum", law.starts_at_optimum},
      {"warm_starts", law.warm_starts}};
  if (law.status == design::TuningStatus::unstable) {
    result["result"] = nullptr;
    return result;
  }
  Json gains = Json::array();
  const auto& descriptions = control::gain_descriptions(law.law.structure);
  for (std::size_t k = 0; k < law.law.gains.size(); ++k) {
    gains.push_back({{"name", descriptions[k].name},
                     {"symbol", descriptions[k].symbol},
                     {"unit", descriptions[k].unit},
                     {"value_si", law.law.gains[k]}});
  }
  Json goals = Json::array();
  for (const auto& goal : law.active_goals) {
    goals.push_back({{"goal", design::describe(goal.goal)}, {"member", text_or_null(goal.member)}});
  }
  result["result"] = {{"beam_rms_mdeg", mdeg(value.beam_rms)},
                      {"wind_rms_mdeg", mdeg(value.wind_rms)},
                      {"noise_rms_mdeg", mdeg(value.noise_rms)},
                      {"worst_goal_ratio_1", number(law.worst_goal_ratio)},
                      {"valve_effort_rad_per_s", number(value.valve_effort)},
                      {"gust_demand_rad_per_s", number(value.gust_demand)},
                      {"gust_torque_N_m", number(value.gust_torque)},
                      {"bandwidth_Hz", number(value.bandwidth)},
                      {"acceleration_error_s2", number(value.acceleration_error)},
                      {"margins", margins_json(value)},
                      {"gains", std::move(gains)},
                      {"active_goals", std::move(goals)},
                      {"gains_at_bound", law.gains_at_bound},
                      {"carried_members", law.carried_members},
                      {"verified", value.verification.passed},
                      {"verification_failure", text_or_null(value.verification.failure)},
                      {"time_domain", time_json(value.time_domain)}};
  return result;
}

Json series_json(const MatchSection& section, const MatchSeries& series) {
  Json laws = Json::array();
  for (std::size_t i = 0; i < section.points.size(); ++i) laws.push_back(law_json(series, i));
  const auto& smooth = series.smoothness;
  Json thirds = Json::array(), kinks = Json::array();
  for (const double third : smooth.third_differences) thirds.push_back(number(third));
  for (const auto& kink : smooth.kinks) {
    kinks.push_back({{"after_grid_point", kink.after}, {"change", kink.change}});
  }
  Json best = nullptr;
  if (series.best) {
    const auto& point = section.points[*series.best];
    best = {{"flywheel_disks_1", point.disks},
            {"motor_to_load_ratio_1", point.motor_to_load_ratio},
            {"beam_rms_mdeg", mdeg(series.values[*series.best].beam_rms)},
            {"at_end_of_range", series.best_at_end},
            {"within_1_percent", range_json(series.within_1_percent)},
            {"within_5_percent", range_json(series.within_5_percent)}};
  }
  return {{"structure", series.name},
          {"description", series.curve.structure.name()},
          {"best", std::move(best)},
          {"third_differences_1", std::move(thirds)},
          {"kinks", std::move(kinks)},
          {"even_stretches", smooth.even_stretches},
          {"largest_third_difference_1", smooth.largest_even},
          {"largest_third_difference_at_kinks_1", smooth.largest_at_kinks},
          {"laws", std::move(laws)}};
}

Json variants_json(const MatchVariants& variants) {
  Json rows = Json::array();
  for (const auto& variant : variants.variants) {
    Json rms = Json::array();
    for (const double value : variant.rms) rms.push_back(mdeg(value));
    rows.push_back(
        {{"name", variant.name},
         {"beam_rms_mdeg", std::move(rms)},
         {"best_disks_1", variant.best ? number(variants.disks[*variant.best]) : Json(nullptr)},
         {"within_5_percent", range_json(variant.within_5_percent)}});
  }
  return {{"structure", variants.structure},
          {"flywheel_disks_1", variants.disks},
          {"variants", std::move(rows)}};
}

}  // namespace

void describe(io::Visitor& v, const MatchMargins& cut) {
  v.defined_as("match_margins", "Margins of a law on the case's plant, the loop cut at one place.");
  io::describe_break(v, "break", cut.loop_break);
  describe(v, cut.margins);
  v.number("sensitivity_peak", cut.margins.sensitivity.magnitude, io::key_units::ratio,
           "Largest |S|.", {.least = 0.0});
}

Json match_json(const MatchSection& section) {
  Json points = Json::array(), series = Json::array(), variants = Json::array();
  Json thresholds = Json::array(), rules = Json::array();
  for (const auto& point : section.points) points.push_back(point_json(point));
  for (const auto& one : section.series) series.push_back(series_json(section, one));
  for (const auto& one : section.variants) variants.push_back(variants_json(one));
  for (const auto& one : section.thresholds) {
    thresholds.push_back(
        {{"structure", one.structure},
         {"spread_1", one.spread},
         {"friction_slope_N_m_s_per_rad", one.slope ? number(*one.slope) : Json(nullptr)},
         {"searched_to_N_m_s_per_rad", one.searched_to},
         {"spread_at_linear_plant_1", number(one.spread_at_nominal)},
         {"spread_at_tracking_rate_1", number(one.spread_at_tracking)}});
  }
  for (const auto& rule : section.rules) {
    Json costs = Json::array();
    for (std::size_t s = 0; s < rule.cost.size(); ++s) {
      costs.push_back(
          {{"structure", section.series[s].name}, {"rms_over_least_1", number(rule.cost[s])}});
    }
    rules.push_back({{"rule", rule.rule},
                     {"motor_to_load_ratio_1", rule.motor_to_load_ratio},
                     {"flywheel_disks_1", rule.disks ? number(*rule.disks) : Json(nullptr)},
                     {"costs", std::move(costs)}});
  }
  Json json{{"wind_model", plant::to_string(section.wind_model)},
            {"wind_speed_m_per_s", section.wind_speed},
            {"soft_goal", design::to_string(section.soft_goal.kind)},
            {"ensemble_members", section.members},
            {"starts", section.starts},
            {"rounds", section.rounds},
            {"settled", section.settled},
            {"evaluations", section.evaluations},
            {"tolerance_1", section.tolerance},
            {"slew_distance_deg", section.slew_distance / millidegree / 1e3},
            {"slew_rate_mdeg_per_s", mdeg(section.slew_rate)},
            {"tracking_rate_mdeg_per_s", mdeg(section.tracking_rate)},
            {"crest_factor_1", section.goals.crest_factor},
            {"friction_slope_N_m_s_per_rad", section.friction},
            {"friction_slope_at_tracking_rate_N_m_s_per_rad", section.tracking_friction},
            {"points", std::move(points)},
            {"series", std::move(series)},
            {"variants", std::move(variants)},
            {"friction_thresholds", std::move(thresholds)},
            {"rules", std::move(rules)}};
  if (section.wind_mast) json["wind_mast"] = mast_json(*section.wind_mast);
  if (section.what_if) json["what_if"] = what_if_json(*section.what_if);
  return json;
}

}  // namespace boresight::app
