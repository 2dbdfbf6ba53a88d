
#include <nlohmann/json.hpp>

#include <boresight/app/report/json_number.hpp>
#include <boresight/app/report/json_time_domain.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

Json mdeg(double angle) {
  return number(angle / millidegree);
}

Json wind_json(const TimeDomainSection& section) {
  const design::WindResult& wind = section.result.wind;
  Json influences = Json::array();
  for (const auto& influence : wind.influences) {
    influences.push_back({{"influence", design::to_string(influence.influence)},
                          {"status", design::to_string(influence.status)},
                          {"beam_rms_without_mdeg", mdeg(influence.beam_rms_without)},
                          {"difference_mdeg", mdeg(influence.difference)}});
  }
  return {{"status", design::to_string(wind.status)},
          {"message", text_or_null(wind.message)},
          {"duration_s", section.options.wind_duration},
          {"seed", section.options.seeds.front()},
          {"beam_rms_mdeg", mdeg(wind.beam_rms)},
          {"encoder_rms_mdeg", mdeg(wind.encoder_rms)},
          {"predicted_rms_mdeg", mdeg(wind.predicted_rms)},
          {"chance_mdeg", mdeg(wind.chance)},
          {"sampling_mdeg", mdeg(wind.sampling)},
          {"influences", std::move(influences)},
          {"joint_mdeg", mdeg(wind.joint)},
          {"at_command_limit_1", wind.at_command_limit}};
}

Json integrators_json(const std::optional<design::IntegratorAgreement>& agreement) {
  if (!agreement) return nullptr;
  const design::IntegratorAgreement& both = *agreement;
  return {{"status", design::to_string(both.status)},
          {"message", text_or_null(both.message)},
          {"agree", design::agree(both)},
          {"duration_s", both.duration},
          {"beam_rms_mdeg", mdeg(both.collocation_rms)},
          {"cvodes_beam_rms_mdeg", mdeg(both.cvodes_rms)},
          {"difference_rms_mdeg", mdeg(both.difference_rms)},
          {"ratio_1", number(both.ratio())},
          {"limit_1", design::integrator_agreement_limit},
          {"cvodes_relative_tolerance_1", both.cvodes_relative_tolerance},
          {"cvodes_absolute_tolerance_si", both.cvodes_absolute_tolerance},
          {"steps", both.collocation_steps},
          {"cvodes_steps", both.cvodes_steps}};
}

Json hunting_json(const design::HuntingResult& hunting) {
  return json_by([&](io::Visitor& v) { describe(v, hunting, io::LimitCycleDetail::full); });
}

Json reversal_json(const design::ReversalResult& reversal) {
  return {{"status", design::to_string(reversal.status)},
          {"message", text_or_null(reversal.message)},
          {"encoder_error_mdeg", mdeg(reversal.encoder_error)},
          {"beam_error_mdeg", mdeg(reversal.beam_error)},
          {"encoder_error_without_friction_mdeg", mdeg(reversal.encoder_error_without_friction)},
          {"time_of_largest_s", number(reversal.time_of_largest)}};
}

Json slew_json(const design::SlewResult& slew, double settled_error) {
  return {{"status", design::to_string(slew.status)},
          {"message", text_or_null(slew.message)},
          {"distance_deg", slew.distance / degree},
          {"rate_limit_deg_per_s", number(slew.limits.rate / degree)},
          {"acceleration_limit_deg_per_s2", number(slew.limits.acceleration / degree)},
          {"limits_within_reach", slew.within_reach},
          {"command_time_s", number(slew.command_time)},
          {"largest_error_mdeg", mdeg(slew.largest_error)},
          {"overshoot_mdeg", mdeg(slew.overshoot)},
          {"settled_error_mdeg", mdeg(settled_error)},
          {"settling_time_s", number(slew.settling_time)},
          {"at_command_limit_1", slew.at_command_limit}};
}

Json candidate_json(const TimeDomainSection::Candidate& candidate, double settled_error) {
  const design::NonlinearVerification& result = candidate.result;
  Json hunting = Json::array();
  for (const auto& one : result.hunting) hunting.push_back(hunting_json(one));
  return {{"law", candidate.law},
          {"status", design::to_string(result.wind.status)},
          {"beam_rms_mdeg", mdeg(result.wind.beam_rms)},
          {"predicted_rms_mdeg", mdeg(result.wind.predicted_rms)},
          {"hunting", std::move(hunting)},
          {"reversal", result.reversal ? reversal_json(*result.reversal) : Json(nullptr)},
          {"slew", result.slew ? slew_json(*result.slew, settled_error) : Json(nullptr)}};
}

}  // namespace

nlohmann::ordered_json compared_run_json(const design::NonlinearVerification& run) {
  Json hunting = Json::array();
  for (const auto& one : run.hunting) hunting.push_back(hunting_json(one));
  return {{"status", design::to_string(run.wind.status)},
          {"message", text_or_null(run.wind.message)},
          {"beam_rms_mdeg", mdeg(run.wind.beam_rms)},
          {"predicted_rms_mdeg", mdeg(run.wind.predicted_rms)},
          {"linear_rms_of_the_record_mdeg", mdeg(run.wind.continuous_rms)},
          {"hunting", std::move(hunting)},
          {"reversal", run.reversal ? reversal_json(*run.reversal) : Json(nullptr)}};
}

nlohmann::ordered_json time_domain_json(const TimeDomainSection& section) {
  const auto& result = section.result;
  Json hunting = Json::array();
  for (const auto& one : result.hunting) hunting.push_back(hunting_json(one));
  Json candidates = Json::array();
  for (const auto& one : section.candidates) {
    candidates.push_back(candidate_json(one, section.options.settled_error));
  }
  return {{"law", section.law},
          {"wind_speed_m_per_s", section.wind_speed},
          {"sample_time_s", section.sample_time},
          {"encoder_resolution_mdeg", mdeg(section.encoder_resolution)},
          {"wind", wind_json(section)},
          {"integrators", integrators_json(result.integrators)},
          {"hunting", std::move(hunting)},
          {"reversal", result.reversal ? reversal_json(*result.reversal) : Json(nullptr)},
          {"slew",
           result.slew ? slew_json(*result.slew, section.options.settled_error) : Json(nullptr)},
          {"candidates", std::move(candidates)}};
}

}  // namespace boresight::app
