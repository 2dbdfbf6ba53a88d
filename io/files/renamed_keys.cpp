#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/renamed_keys.hpp>

namespace boresight::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto table = std::to_array<RenamedKey>(
    {{"active_goals", "active_constraints"},
     {"assumed_shares", "assumed_fractions"},
     {"beam_amplitude_mdeg", "boresight_amplitude_mdeg"},
     {"beam_error_mdeg", "boresight_error_mdeg"},
     {"beam_mean_mdeg", "boresight_mean_mdeg"},
     {"beam_rms_mdeg", "boresight_rms_mdeg"},
     {"beam_rms_without_mdeg", "boresight_rms_without_mdeg"},
     {"carried_members", "active_scenarios"},
     {"chance_mdeg", "realisation_error_mdeg"},
     {"choices", "interpretations"},
     {"climate_beam_rms_mdeg", "climate_boresight_rms_mdeg"},
     {"consequences", "derived_quantities"},
     {"cvodes_beam_rms_mdeg", "cvodes_boresight_rms_mdeg"},
     {"draws", "samples"},
     {"draws_below_motor_inertia_1", "samples_below_motor_inertia_1"},
     {"encoder_held_mdeg_per_MN_m", "flexure_mdeg_per_MN_m"},
     {"encoder_held_rms_mdeg", "flexure_rms_mdeg"},
     {"front", "pareto_front"},
     {"gear_share_1", "gear_fraction_1"},
     {"goal", "constraint"},
     {"goals", "constraints"},
     {"goals_met", "constraints_met"},
     {"higher_beam_rms_mdeg", "higher_boresight_rms_mdeg"},
     {"hunting", "limit_cycles"},
     {"joint_mdeg", "interaction_mdeg"},
     {"judged_rms_mdeg", "evaluated_rms_mdeg"},
     {"knowing_everything", "perfect_information"},
     {"largest_beam_rms_mdeg", "largest_boresight_rms_mdeg"},
     {"law", "controller"},
     {"laws", "controllers"},
     {"laws_found", "controllers_found"},
     {"least", "minimum"},
     {"least_beam_rms_mdeg", "min_boresight_rms_mdeg"},
     {"least_mean_rms", "min_mean_rms"},
     {"least_rms_at_own_effort_mdeg", "min_rms_at_own_effort_mdeg"},
     {"least_rms_mdeg", "min_rms_mdeg"},
     {"limits_within_reach", "limits_achievable"},
     {"linear_models.law", "linear_models.controller_name"},
     {"lower_beam_rms_mdeg", "lower_boresight_rms_mdeg"},
     {"lyapunov_beam_rms_mdeg", "lyapunov_boresight_rms_mdeg"},
     {"median_beam_rms_mdeg", "median_boresight_rms_mdeg"},
     {"nonlinear_factor_1", "simulated_to_linear_rms_1"},
     {"oil_share_1", "oil_fraction_1"},
     {"on_front_share_1", "on_pareto_front_fraction_1"},
     {"price_of_one_law_1", "cost_of_fixed_gains_1"},
     {"probability_all_goals_met_1", "probability_all_constraints_met_1"},
     {"quantile_95_beam_rms_mdeg", "quantile_95_boresight_rms_mdeg"},
     {"reconciled", "combined"},
     {"reconciled_N_m", "combined_N_m"},
     {"reconciled_lower_95_N_m", "combined_lower_95_N_m"},
     {"reconciled_upper_95_N_m", "combined_upper_95_N_m"},
     {"resolved_share_1", "resolved_fraction_1"},
     {"retuned_beam_rms_mdeg", "retuned_boresight_rms_mdeg"},
     {"return_share_1", "return_fraction_1"},
     {"reversal_beam_error_mdeg", "reversal_boresight_error_mdeg"},
     {"rms_over_least_1", "rms_over_min_1"},
     {"sensitivity_goals", "sensitivity_constraints"},
     {"sensitivity_peak_goals_1", "sensitivity_peak_limits_1"},
     {"share_1", "fraction_1"},
     {"share_of_time_1", "fraction_of_time_1"},
     {"simulated_beam_rms_mdeg", "simulated_boresight_rms_mdeg"},
     {"soft_goal", "objective"},
     {"stable_share_1", "stable_fraction_1"},
     {"standing", "stability_verdict"},
     {"starts_hunting", "starts_with_limit_cycle"},
     {"step_peak_to_encoder_held_1", "step_peak_to_flexure_1"},
     {"still_encoder_error_mdeg", "calm_encoder_error_mdeg"},
     {"still_tachometer_rad_per_s", "calm_tachometer_rad_per_s"},
     {"still_torque_N_m", "calm_torque_N_m"},
     {"still_valve_command_rad_per_s", "calm_valve_command_rad_per_s"},
     {"supply_wind_speed_m_per_s", "torque_limited_wind_speed_m_per_s"},
     {"test_value", "sample_information"},
     {"to_encoder_held_1", "to_flexure_1"},
     {"to_least_1", "to_min_1"},
     {"to_least_at_own_effort_1", "to_min_at_own_effort_1"},
     {"torque_for_wind_N_m", "available_wind_torque_N_m"},
     {"unstable_under_held_law", "unstable_with_fixed_gains"},
     {"valve_effort_goal_rad_per_s", "control_effort_constraint_rad_per_s"},
     {"valve_effort_limit_rad_per_s", "control_effort_limit_rad_per_s"},
     {"valve_effort_rad_per_s", "control_effort_rad_per_s"},
     {"variance_share_1", "variance_fraction_1"},
     {"winding_contradicted", "encirclements_contradicted"},
     {"within_goals", "within_constraints"},
     {"within_goals_share_1", "within_constraints_fraction_1"},
     {"worst_goal_ratio_1", "worst_constraint_1"},
     {"worst_to_encoder_held_1", "worst_to_flexure_1"}});

std::string_view present_key(std::string_view key) {
  const auto* found = std::ranges::find(table, key, &RenamedKey::before);
  return found == table.end() ? key : found->now;
}

// Adds the keys renamed to `found`.
void rename(Json& json, std::set<std::string>& found) {
  if (json.is_array()) {
    for (auto& element : json) rename(element, found);
  }
  if (!json.is_object()) return;
  Json renamed = Json::object();
  for (auto& [key, value] : json.items()) {
    rename(value, found);
    const std::string now(present_key(key));
    const bool apply = now != key && !json.contains(now);
    if (apply) found.insert(key);
    renamed[apply ? now : key] = std::move(value);
  }
  json = std::move(renamed);
}

}  // namespace

std::span<const RenamedKey> renamed_keys() {
  return table;
}

void use_present_keys(Json& report, const std::string& path) {
  std::set<std::string> found;
  rename(report, found);
  if (found.empty()) return;
  std::string pairs;
  for (const auto& key : found) {
    pairs += fmt::format("{}'{}' is now '{}'", pairs.empty() ? "" : ", ", key, present_key(key));
  }
  note_warning(
      fmt::format("{}: keys of version 0.1: {}; the next version refuses them", path, pairs));
}

}  // namespace boresight::io
