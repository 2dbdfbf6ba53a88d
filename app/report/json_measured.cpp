
#include <nlohmann/json.hpp>

#include <boresight/app/report/json_number.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

const char* basis_name(control::ResponseBasis basis) {
  switch (basis) {
    case control::ResponseBasis::assumed_below:
      return "assumed below";
    case control::ResponseBasis::measured:
      return "measured";
    case control::ResponseBasis::encoder_assumed:
      return "encoder assumed";
    case control::ResponseBasis::unresolved:
      return "unresolved";
    case control::ResponseBasis::assumed_above:
      return "assumed above";
  }
  return "measured";
}

const char* status_name(design::MeasuredTuningStatus status) {
  switch (status) {
    case design::MeasuredTuningStatus::confident:
      return "confident";
    case design::MeasuredTuningStatus::nominal:
      return "nominal";
    case design::MeasuredTuningStatus::infeasible:
      return "infeasible";
    case design::MeasuredTuningStatus::unstable:
      return "unstable";
  }
  return "unstable";
}

Json share_json(const design::AssumedShare& share) {
  return {{"below_1", number(share.below)},
          {"encoder_1", number(share.encoder)},
          {"unresolved_1", number(share.unresolved)},
          {"above_1", number(share.above)}};
}

Json bands_json(const std::vector<control::PointBand>& bands) {
  Json json = Json::array();
  for (const auto& band : bands) {
    json.push_back({{"lowest_Hz", band.lowest / two_pi}, {"highest_Hz", band.highest / two_pi}});
  }
  return json;
}

Json law_json(const MeasuredTuneSection& section, const MeasuredLaw& law) {
  const auto& tuning = law.tuning;
  Json json{{"structure", law.structure}, {"status", status_name(tuning.status)}};
  if (tuning.status == design::MeasuredTuningStatus::unstable) return json;
  const double to_sky = 1.0 / section.gear_ratio / millidegree;
  Json gains = Json::array();
  const auto& descriptions = control::gain_descriptions(tuning.law.structure);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    gains.push_back({{"name", descriptions[k].name},
                     {"symbol", descriptions[k].symbol},
                     {"unit", descriptions[k].unit},
                     {"value_si", tuning.law.gains[k]}});
  }
  json["gains"] = std::move(gains);
  json["rms_mdeg"] = number(tuning.rms * to_sky);
  json["wind_rms_mdeg"] = number(tuning.wind_rms * to_sky);
  json["noise_rms_mdeg"] = number(tuning.noise_rms * to_sky);
  json["nominal_rms_mdeg"] = number(tuning.nominal_rms * to_sky);
  json["valve_effort_rad_per_s"] = number(tuning.valve_effort);
  json["assumed_shares"] = {{"wind", share_json(tuning.wind_share)},
                            {"noise", share_json(tuning.noise_share)},
                            {"effort", share_json(tuning.effort_share)}};
  json["rms_by_oil_stiffness_1"] = number(tuning.by_stiffness);
  json["rms_by_oil_loss_rate_1"] = number(tuning.by_loss_rate);
  json["confidence_1"] = tuning.confidence;
  json["confidence_radius_1"] = number(tuning.radius);
  const auto& check = tuning.verification;
  Json breaks = Json::array();
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    const auto& peak = check.peaks.at(b);
    breaks.push_back(
        {{"loop_break", control::to_string(control::loop_breaks.at(b))},
         {"sensitivity_peak_1", number(peak.measured.magnitude)},
         {"sensitivity_peak_frequency_Hz", number(peak.measured.frequency / two_pi)},
         {"sensitivity_peak_within_confidence_1", number(peak.within_confidence.magnitude)},
         {"within_confidence_frequency_Hz", number(peak.within_confidence.frequency / two_pi)},
         {"basis", basis_name(peak.basis)},
         {"phase_margin_deg", number(check.margins.at(b).margins.phase_margin_deg)},
         {"unresolved_intervals", check.margins.at(b).unresolved.size()}});
  }
  json["loop_breaks"] = std::move(breaks);
  json["verified"] = check.passed;
  json["verification_failure"] = check.failure.empty() ? Json(nullptr) : Json(check.failure);
  json["unstable_poles_rate_loop_alone"] = check.unstable[0];
  json["unstable_poles"] = check.unstable[1];
  json["largest_relative_error_1"] = number(check.largest_error);
  json["loop_gain_at_highest_rate_loop_alone_1"] = number(check.gain_at_highest[0]);
  json["loop_gain_at_highest_1"] = number(check.gain_at_highest[1]);
  json["stable_on_case"] = law.stable_on_case;
  json["sensitivity_peaks_on_case_1"] =
      law.stable_on_case ? Json(law.peaks_on_case) : Json(nullptr);
  json["active_goals"] = tuning.active_goals;
  json["gains_at_bound"] = tuning.gains_at_bound;
  json["starts"] = tuning.starts;
  json["starts_at_optimum"] = tuning.starts_at_optimum;
  json["rounds"] = tuning.rounds;
  json["evaluations"] = tuning.evaluations;
  return json;
}

}  // namespace

nlohmann::ordered_json measured_tuning_json(const MeasuredTuneSection& section) {
  Json laws = Json::array();
  for (const auto& law : section.laws) laws.push_back(law_json(section, law));
  Json json{{"record", section.record},
            {"start_s", section.start},
            {"length_s", section.length},
            {"mean_motor_rate_rad_per_s", section.mean_rate},
            {"lowest_excited_Hz", section.lowest_excited},
            {"highest_excited_Hz", section.highest_excited}};
  if (section.channels) {
    const control::MeasuredChannels& channels = *section.channels;
    json["lowest_Hz"] = channels.lowest_frequency() / two_pi;
    json["highest_Hz"] = channels.highest_frequency() / two_pi;
    json["frequencies"] = channels.frequency().size();
    json["frequencies_left_out"] = channels.points_left_out();
    json["resolved_share_1"] = number(channels.resolved_share());
    json["unresolved"] = bands_json(channels.unresolved());
    json["encoder_assumed"] = bands_json(channels.encoder_assumed());
    json["inertia_kg_m2"] = number(channels.low_end_inertia());
    json["friction_N_m_s_per_rad"] = number(channels.low_end_friction());
  }
  json["encoder_column"] =
      section.encoder_column.empty() ? Json(nullptr) : Json(section.encoder_column);
  json["oil_stiffness_N_m_per_rad"] = section.oil.stiffness;
  json["oil_loss_rate_per_s"] = section.oil.loss_rate;
  json["oil_source"] = section.oil_source;
  json["wind_speed_m_per_s"] = section.wind_speed;
  json["sensitivity_peak_goals_1"] = section.goals.sensitivity_peak;
  json["valve_effort_goal_rad_per_s"] = section.goals.valve_effort;
  json["laws"] = std::move(laws);
  json["notes"] = section.notes;
  return json;
}

}  // namespace boresight::app
