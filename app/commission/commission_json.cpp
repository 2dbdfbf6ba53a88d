
#include <nlohmann/json.hpp>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/report/json_number.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

Json band(const design::PlantBand& band, double unit = 1.0) {
  return {{"nominal", number(band.nominal / unit)},
          {"least", number(band.least / unit)},
          {"largest", number(band.largest / unit)},
          {"lower", number(band.lower / unit)},
          {"upper", number(band.upper / unit)}};
}

Json expected_json(const design::StageExpectation& expected, double sky) {
  const double turn = two_pi;
  return {{"plants", expected.plants},
          {"stable_plants", expected.stable},
          {"sensitivity_peak_1", band(expected.peak)},
          {"crossover_Hz", band(expected.crossover, turn)},
          {"rise_time_s", band(expected.rise_time)},
          {"overshoot_1", band(expected.overshoot)},
          {"settling_time_s", band(expected.settling_time)},
          {"still_encoder_error_mdeg", band(expected.still_encoder, sky)},
          {"still_tachometer_rad_per_s", band(expected.still_tachometer)},
          {"still_torque_N_m", band(expected.still_torque)},
          {"still_valve_command_rad_per_s", band(expected.still_valve)},
          {"windy_encoder_error_mdeg", band(expected.windy_encoder, sky)},
          {"windy_tachometer_rad_per_s", band(expected.windy_tachometer)},
          {"windy_torque_N_m", band(expected.windy_torque)},
          {"windy_valve_command_rad_per_s", band(expected.windy_valve)},
          {"beam_rms_mdeg", band(expected.beam_rms, sky)},
          {"move_error_mdeg", band(expected.move_error, sky)}};
}

Json sheet_json(const StageSheet& sheet, double sky) {
  Json gains = Json::array();
  for (const auto& gain : sheet.gains) {
    gains.push_back({{"symbol", gain.symbol},
                     {"name", gain.name},
                     {"value", gain.text},
                     {"value_SI", number(gain.value)},
                     {"changed", gain.changed}});
  }
  const auto& abort = sheet.stage.abort;
  return {{"kind", to_string(sheet.stage.kind)},
          {"step", sheet.stage.step},
          {"steps", sheet.stage.steps},
          {"position_loop", sheet.stage.law.position_open ? "open" : "closed"},
          {"feedforward", sheet.stage.law.feedforward},
          {"gains", std::move(gains)},
          {"command_step_mdeg_or_mdeg_per_s", number(sheet.step / millidegree)},
          {"expected", expected_json(sheet.stage.expected, sky)},
          {"abort",
           {{"overshoot_1", number(abort.overshoot)},
            {"still_valve_command_rad_per_s", number(abort.still_valve_rms)},
            {"still_encoder_error_mdeg", number(abort.still_encoder_rms / sky)},
            {"gain_reserve_1", number(abort.gain_reserve)},
            {"worst_plant", abort.worst_plant}}},
          {"check", sheet.check},
          {"abort_text", sheet.abort},
          {"way_back", sheet.way_back}};
}

Json band_json(const design::BandComparison& band) {
  return {{"lowest_Hz", number(band.lowest)},
          {"highest_Hz", number(band.highest)},
          {"rms_before", number(band.rms_before)},
          {"rms_after", number(band.rms_after)},
          {"freedom_before_1", number(band.freedom_before)},
          {"freedom_after_1", number(band.freedom_after)},
          {"ratio_1", number(band.ratio)},
          {"ratio_lower_1", number(band.lower)},
          {"ratio_upper_1", number(band.upper)},
          {"change", to_string(band.change)}};
}

Json comparison_json(const ChannelComparison& channel) {
  Json bands = Json::array();
  for (const auto& band : channel.comparison.bands) bands.push_back(band_json(band));
  return {
      {"channel", channel.channel},
      {"unit", channel.unit},
      {"not_compared", channel.not_compared.empty() ? Json(nullptr) : Json(channel.not_compared)},
      {"whole", band_json(channel.comparison.whole)},
      {"bands", std::move(bands)},
      {"predicted_ratio_1", number(channel.predicted)},
      {"predicted_ratio_lower_1", number(channel.predicted_lower)},
      {"predicted_ratio_upper_1", number(channel.predicted_upper)},
      {"agrees", channel.predicted ? Json(channel.agrees) : Json(nullptr)},
      {"frequency_Hz", channel.comparison.frequency},
      {"density_before_per_Hz", channel.comparison.density_before},
      {"density_after_per_Hz", channel.comparison.density_after}};
}

}  // namespace

std::string to_json(const CommissionReport& report) {
  const double sky = report.gear_ratio * millidegree;
  Json stages = Json::array();
  for (const auto& sheet : report.sheets) stages.push_back(sheet_json(sheet, sky));
  Json comparisons = Json::array();
  for (const auto& channel : report.comparisons) comparisons.push_back(comparison_json(channel));
  Json assumed = Json::array();
  for (const auto& quantity : report.assumed) {
    assumed.push_back({{"key", quantity.key}, {"value", quantity.text}});
  }
  const Json json{
      {"command", "commission"},
      {"case", report.case_path},
      {"title", report.title},
      {"axis", report.axis},
      {"seed", report.seed},
      {"structure", report.structure},
      {"gains_from", report.tuned ? "tuning" : "user"},
      {"ensemble", {{"plants", report.ensemble_size}, {"source", report.ensemble_source}}},
      {"wind", {{"model", report.wind_model}, {"mean_speed_m_per_s", number(report.wind_speed)}}},
      {"move",
       {{"rate_mdeg_per_s", number(report.move.rate / sky)},
        {"acceleration_mdeg_per_s2", number(report.move.acceleration / sky)}}},
      {"largest_step_1",
       report.failure == nullptr ? number(report.plan.largest_step) : Json(nullptr)},
      {"sensitivity_limit_1", number(report.options.sensitivity_limit)},
      {"abort_peak_1", number(report.options.abort_peak)},
      {"confidence_1", number(report.options.confidence)},
      {"assumed_detuning_1", number(report.plan.detuning)},
      {"no_plan", report.no_plan.empty() ? Json(nullptr) : Json(report.no_plan)},
      {"remarks", report.plan.remarks},
      {"stages", std::move(stages)},
      {"record_before", report.before.empty() ? Json(nullptr) : Json(report.before)},
      {"record_after", report.after.empty() ? Json(nullptr) : Json(report.after)},
      {"comparisons", std::move(comparisons)},
      {"conclusions", report.conclusions},
      {"figures", figures_json(report.figures)},
      {"assumed", std::move(assumed)}};
  return json.dump(2) + "\n";
}

}  // namespace boresight::app
