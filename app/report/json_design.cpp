#include <algorithm>
#include <cmath>
#include <map>

#include <boresight/app/report/json_design.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

Json margins_json(const control::Margins& margins) {
  const auto decibel = [](double factor) {
    return factor > 0.0 ? number(20.0 * std::log10(factor)) : Json(nullptr);
  };
  return {{"phase_margin_deg", number(margins.phase_margin_deg)},
          {"increasing_gain_margin_dB", decibel(margins.increasing_gain_margin)},
          {"decreasing_gain_margin_dB", decibel(margins.decreasing_gain_margin)},
          {"delay_margin_s", number(margins.delay_margin)}};
}

std::string gain_key(const control::GainDescription& gain) {
  static const std::map<std::string, std::string> endings{{"1", "_1"},
                                                          {"1/s", "_per_s"},
                                                          {"rad/s", "_rad_per_s"},
                                                          {"rad/(s.N.m)", "_rad_per_s_N_m"},
                                                          {"rad/(N.m)", "_rad_per_N_m"}};
  std::string key(gain.name);
  std::ranges::replace(key, ' ', '_');
  return key + endings.at(gain.unit);
}

}  // namespace

Json share_of_time_json(const std::vector<design::ClimatePart>& climate, double speed) {
  if (climate.empty() || std::isnan(speed)) return nullptr;
  return number(design::share_of_time(climate, speed));
}

Json mode_json(const plant::PlantMode& mode) {
  return {{"description", mode.description},
          {"frequency_Hz", number(mode.frequency)},
          {"damping_ratio_1", number(mode.damping_ratio)},
          {"pole_real_rad_per_s", number(mode.pole.real())},
          {"pole_imaginary_rad_per_s", number(mode.pole.imag())},
          {"participation_1", number(mode.participation)},
          {"oil_share_1", number(mode.oil_share)},
          {"gear_share_1", number(mode.gear_share)}};
}

Json design_json(const design::Design& design) {
  Json gains;
  const auto& law = design.tuning.law;
  const auto& descriptions = control::gain_descriptions(law.structure);
  for (std::size_t i = 0; i < law.gains.size(); ++i) {
    gains[gain_key(descriptions[i])] = law.gains[i];
  }
  Json breaks = Json::array();
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    const auto& peak = design.verification.peaks[b];
    breaks.push_back({{"loop_break", control::to_string(control::loop_breaks[b])},
                      {"sensitivity_peak_1", number(peak.upper)},
                      {"sensitivity_peak_lower_bound_1", number(peak.lower)},
                      {"sensitivity_peak_frequency_Hz", number(peak.frequency / two_pi)},
                      {"margins", margins_json(design.margins[b])}});
  }
  const auto& check = design.verification;
  return {{"structure", control::to_string(law.structure)},
          {"feasible", design.tuning.status == design::TuningStatus::optimal},
          {"verified", check.passed},
          {"verification_failure", text_or_null(check.failure)},
          {"gains", std::move(gains)},
          {"beam_rms_mdeg", number(design.beam_rms / millidegree)},
          {"wind_rms_mdeg", number(design.wind_rms / millidegree)},
          {"noise_rms_mdeg", number(design.noise_rms / millidegree)},
          {"valve_effort_rad_per_s", number(design.valve_effort)},
          {"loop_breaks", std::move(breaks)},
          {"hydraulic_mode", mode_json(design.hydraulic_mode)},
          {"active_goals", design.tuning.active_goals},
          {"gains_at_bound", design.tuning.gains_at_bound},
          {"worst_goal_ratio_1", number(design.tuning.worst_goal_ratio)},
          {"starts", design.tuning.starts},
          {"starts_at_optimum", design.tuning.starts_at_optimum},
          {"evaluations", design.tuning.evaluations},
          {"verification",
           {{"rate_loop_abscissa_per_s", number(check.stability.rate_loop_abscissa)},
            {"closed_loop_abscissa_per_s", number(check.stability.closed_loop_abscissa)},
            {"dead_time_residue_1", number(check.stability.dead_time_residue)},
            {"lyapunov_to_spectral_rms_1", number(check.lyapunov.total / check.spectral_rms)}}}};
}

Json ensemble_json(const design::EnsembleResult& ensemble) {
  Json members = Json::array();
  for (const auto& member : ensemble.members) {
    Json peaks = Json::array();
    for (const double peak : member.sensitivity_peaks) peaks.push_back(number(peak));
    members.push_back({{"name", member.name},
                       {"stable", member.stable},
                       {"beam_rms_mdeg", number(member.beam_rms / millidegree)},
                       {"sensitivity_peaks_1", std::move(peaks)},
                       {"valve_effort_rad_per_s", number(member.valve_effort)},
                       {"worst_goal_ratio_1", number(member.worst_goal_ratio)}});
  }
  return {{"stable", ensemble.stable},
          {"within_goals", ensemble.within_goals},
          {"least_beam_rms_mdeg", number(ensemble.least_rms / millidegree)},
          {"median_beam_rms_mdeg", number(ensemble.median_rms / millidegree)},
          {"quantile_95_beam_rms_mdeg", number(ensemble.high_rms / millidegree)},
          {"largest_beam_rms_mdeg", number(ensemble.largest_rms / millidegree)},
          {"worst", ensemble.members[ensemble.worst].name},
          {"members", std::move(members)}};
}

}  // namespace boresight::app
