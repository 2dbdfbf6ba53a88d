#include <optional>

#include <boresight/app/report/json_limit.hpp>
#include <boresight/app/report/json_number.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

Json mdeg(double angle) {
  return number(angle / millidegree);
}

Json result_json(const design::SampledResult& result) {
  return {{"plant", result.plant},
          {"stable", result.stable()},
          {"spectral_radius_1", number(result.spectral_radius)},
          {"beam_rms_mdeg", mdeg(result.beam_rms)},
          {"wind_rms_mdeg", mdeg(result.wind_rms)},
          {"noise_rms_mdeg", mdeg(result.noise_rms)},
          {"valve_effort_rad_per_s", number(result.valve_effort)},
          {"sensitivity_peak_1", number(result.peak.magnitude)},
          {"sensitivity_peak_frequency_Hz", number(result.peak.frequency / two_pi)}};
}

Json design_json(const design::SampledDesign& design) {
  Json members = Json::array();
  for (const auto& member : design.members) members.push_back(result_json(member));
  return {{"controller_states", design.controller.a.rows()},
          {"nominal", result_json(design.nominal)},
          {"stable_members", design.stable_members},
          {"worst_rms_mdeg", mdeg(design.worst_rms)},
          {"members", std::move(members)}};
}

Json lqg_json(const std::optional<design::LimitedLqg>& lqg) {
  if (!lqg) return nullptr;
  Json json = design_json(lqg->design);
  json["weights"] = {{"command_weight_s2", number(lqg->weights.command_weight)},
                     {"input_noise_rad2_per_s", number(lqg->weights.input_noise)},
                     {"spring_noise_rad2_s", number(lqg->weights.spring_noise)},
                     {"spring_weight_1", number(lqg->weights.spring_weight)},
                     {"friction_noise_N2_m2_s", number(lqg->weights.friction_noise)}};
  return json;
}

}  // namespace

nlohmann::ordered_json limit_json(const design::PointingLimit& limit) {
  constexpr double square = millidegree * millidegree;
  Json points = Json::array();
  for (const auto& point : limit.bound.points) {
    points.push_back({{"weight_mdeg2_s2_per_rad2", number(point.weight / square)},
                      {"cost_mdeg2", number(point.cost / square)}});
  }
  Json laws = Json::array();
  for (const auto& law : limit.laws) {
    laws.push_back({{"name", law.name},
                    {"design", design_json(law.design)},
                    {"least_rms_mdeg", mdeg(law.least_rms)},
                    {"to_least_1", number(law.to_least)},
                    {"to_margin_limited_1", number(law.to_margin_limited)},
                    {"to_robustified_1", number(law.to_robustified)},
                    {"worst_to_robustified_1", number(law.worst_to_robustified)},
                    {"to_encoder_held_1", number(law.to_encoder_held)},
                    {"to_full_information_1", number(law.to_full_information)}});
  }
  return {{"sample_time_s", limit.sample_time},
          {"computation_delay_s", limit.computation_delay},
          {"valve_effort_limit_rad_per_s", limit.effort_limit},
          {"sensitivity_peak_limit_1", limit.peak_limit},
          {"wind_filter_log_error_1", number(limit.wind_filter_log_error)},
          {"bound_points", std::move(points)},
          {"least_rms_mdeg", mdeg(limit.least_rms)},
          {"unconstrained", design_json(limit.unconstrained)},
          {"margin_limited", lqg_json(limit.margin_limited)},
          {"robustified", lqg_json(limit.robustified)},
          {"full_information_rms_mdeg", mdeg(limit.full_information_rms)},
          {"encoder_held_rms_mdeg", mdeg(limit.encoder_held_rms)},
          {"laws", std::move(laws)}};
}

}  // namespace boresight::app
