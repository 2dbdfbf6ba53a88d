
#include <nlohmann/json.hpp>

#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/report/json_number.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/simulate/simulation_report.hpp>

namespace boresight::app {
namespace {

Json sampled_json(const SampledEvent& event) {
  return {{"first_s", number(event.first)},
          {"samples", event.samples},
          {"share_1", number(event.share)}};
}

Json events_json(const RunEvents& events) {
  constexpr std::size_t listed = 1000;
  Json starts = Json::array();
  for (const auto& start : events.sliding_starts) {
    if (starts.size() == listed) break;
    starts.push_back({{"time_s", number(start.time)},
                      {"direction", start.upward ? "up" : "down"},
                      {"rate_rad_per_s", number(start.rate)},
                      {"friction_N_m", number(start.friction)},
                      {"motor_torque_N_m", number(start.motor_torque)},
                      {"shows_breakaway", start.shows_breakaway}});
  }
  const auto& work = events.integrator;
  return {{"sliding_start_count", events.sliding_starts.size()},
          {"sliding_starts", std::move(starts)},
          {"command_limit", sampled_json(events.command_limit)},
          {"stroke_limit", sampled_json(events.stroke_limit)},
          {"slew_limit", sampled_json(events.slew_limit)},
          {"contact_lost", sampled_json(events.contact_lost)},
          {"contact_losses", events.contact_losses},
          {"below_makeup", sampled_json(events.below_makeup)},
          {"below_zero", sampled_json(events.below_zero)},
          {"lowest_pressure_Pa", number(events.lowest_pressure)},
          {"highest_pressure_Pa", number(events.highest_pressure)},
          {"integrator",
           {{"steps", work.steps},
            {"rejected", work.rejected},
            {"newton_iterations", work.newton_iterations},
            {"halvings_of_interval", work.finest_rung}}}};
}

Json drive_json(const DriveRecord& record) {
  Json clipped = Json::array();
  for (const auto& channel : record.clipped) {
    clipped.push_back({{"channel", channel.name},
                       {"samples", channel.samples},
                       {"first_s", number(channel.first)}});
  }
  return {{"test", record.test},
          {"description", record.description},
          {"complete", record.complete},
          {"duration_s", number(record.duration)},
          {"sample_time_s", number(record.sample_time)},
          {"largest_rate_rad_per_s", number(record.largest_rate)},
          {"largest_torque_N_m", number(record.largest_torque)},
          {"friction_near_rest_N_m", number(record.static_friction)},
          {"curve_breakaway_N_m", number(record.curve_breakaway)},
          {"tachometer_at_limit_1", number(record.at_limit)},
          {"clipped_channels", std::move(clipped)},
          {"events", events_json(record.events)}};
}

Json position_json(const PositionRecord& record) {
  return {{"test", record.test},
          {"description", record.description},
          {"complete", record.complete},
          {"duration_s", number(record.duration)},
          {"sample_time_s", number(record.sample_time)},
          {"beam_rms_mdeg", number(record.beam_rms, millidegree)},
          {"beam_mean_mdeg", number(record.beam_mean, millidegree)},
          {"encoder_rms_mdeg", number(record.encoder_rms, millidegree)},
          {"predicted_rms_mdeg", number(record.predicted_rms, millidegree)},
          {"settling_time_s", number(record.settling_time)},
          {"overshoot_mdeg", number(record.overshoot, millidegree)},
          {"events", events_json(record.events)}};
}

}  // namespace

std::string to_json(const SimulationReport& report) {
  Json json{{"program", "boresight"},
            {"version", BORESIGHT_VERSION},
            {"command", "simulate"},
            {"case", {{"path", report.case_path}, {"title", report.title}, {"axis", report.axis}}},
            {"seed", report.seed},
            {"interrupted", report.interrupted},
            {"failure", report.failure.empty()
                            ? Json(nullptr)
                            : Json{{"test", report.failed_test}, {"message", report.failure}}},
            {"not_run", report.not_run},
            {"drive_tests", Json::array()},
            {"position_tests", Json::array()},
            {"records", report.written},
            {"assumed_inputs", Json::array()},
            {"figures", figures_json(report.figures)}};
  for (const auto& record : report.drive) json["drive_tests"].push_back(drive_json(record));
  for (const auto& record : report.position) {
    json["position_tests"].push_back(position_json(record));
  }
  for (const auto& quantity : report.assumed) {
    const bool value = quantity.basis == io::Basis::assumed;
    json["assumed_inputs"].push_back(
        {{"key", quantity.key},
         {"value", quantity.text},
         {"assumed", value ? "value" : "uncertainty"},
         {"source", value ? quantity.source : quantity.uncertainty_source}});
  }
  return json.dump(2) + "\n";
}

}  // namespace boresight::app
