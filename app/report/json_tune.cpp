#include <algorithm>
#include <cmath>

#include <boresight/app/report/json_tune.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

template <typename Number>
Json optional_number(const std::optional<Number>& value, double unit = 1.0) {
  return value ? number(*value / unit) : Json(nullptr);
}

Json decibel(const std::optional<double>& factor) {
  return factor ? number(20.0 * std::log10(*factor)) : Json(nullptr);
}

Json goals_json(const TuneSection& section) {
  const design::HardGoals& goals = section.goals;
  Json breaks = Json::array();
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    breaks.push_back({{"loop_break", control::to_string(control::loop_breaks.at(b))},
                      {"sensitivity_peak_1", goals.sensitivity_peak.at(b)},
                      {"gain_margin_dB", decibel(goals.gain_margin.at(b))},
                      {"phase_margin_deg", optional_number(goals.phase_margin.at(b), degree)}});
  }
  const bool over_quantile = section.soft_goal.kind == design::SoftGoalKind::quantile;
  return {{"loop_breaks", std::move(breaks)},
          {"valve_effort_rad_per_s", goals.valve_effort},
          {"bandwidth_Hz", optional_number(goals.bandwidth, two_pi)},
          {"crest_factor_1", goals.ask_for_gusts() ? number(goals.crest_factor) : Json(nullptr)},
          {"gust_demand_rad_per_s", optional_number(goals.gust_demand)},
          {"gust_torque_N_m", optional_number(goals.gust_torque)},
          {"beam_rms_mdeg", optional_number(section.beam_rms_goal, millidegree)},
          {"soft_goal", design::to_string(section.soft_goal.kind)},
          {"quantile_1", over_quantile ? number(section.soft_goal.quantile) : Json(nullptr)},
          {"rms_over", section.minimises_climate ? "climate" : "design_speed"}};
}

std::string status_of(const TunedLaw& row) {
  switch (row.design.tuning.status) {
    case design::TuningStatus::optimal:
      return row.goals_met ? "goals met" : "goals missed";
    case design::TuningStatus::infeasible:
      return "goals missed";
    case design::TuningStatus::unstable:
      break;
  }
  return "no stable law";
}

Json limits_json(const design::TuningResult& tuning) {
  Json limits = Json::array();
  for (const auto& limit : tuning.limits) {
    limits.push_back({{"goal", design::describe(limit.goal)},
                      {"plant", limit.member.empty() ? "nominal" : limit.member},
                      {"ratio_to_limit_1", number(limit.goal.ratio)},
                      {"rms_per_limit_1", number(limit.price)}});
  }
  return limits;
}

}  // namespace

Json law_json(const TuneSection& section, const TunedLaw& row) {
  const auto& descriptions = row.design.tuning.law.structure.gains();
  Json gains = Json::array();
  const auto texts = section.gains_of(row);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    gains.push_back(
        {{"symbol", descriptions[i].symbol}, {"name", descriptions[i].name}, {"value", texts[i]}});
  }
  const auto loss = [&](std::optional<double> rms, const design::PointingBand& band) {
    return rms ? number(design::pointing_loss_db(*rms, band.beamwidth,
                                                 design::LossConvention::mean_loss_two_axes))
               : Json(nullptr);
  };
  Json bands = Json::array();
  for (const auto& band : section.bands) {
    bands.push_back({{"name", band.name},
                     {"mean_loss_two_axes_dB", loss(row.beam_rms, band)},
                     {"climate_mean_loss_two_axes_dB", loss(row.climate_rms, band)}});
  }
  Json budgets = Json::array();
  for (std::size_t i = 0; i < row.speed_limits.size(); ++i) {
    budgets.push_back({{"name", section.budgets[i].name},
                       {"band", section.budgets[i].band},
                       {"wind_speed_limit_m_per_s", number(row.speed_limits[i])},
                       {"share_of_time_1",
                        share_of_time_json(section.climate, std::min(row.speed_limits[i],
                                                                     section.supply_wind_speed))}});
  }
  const auto& tuning = row.design.tuning;
  return {{"structure", row.structure},
          {"tuned_for", to_string(row.tuned_for)},
          {"design_wind_speed_m_per_s", row.wind_speed},
          {"status", status_of(row)},
          {"goals_met", row.goals_met},
          {"interrupted", tuning.interrupted},
          {"recommended", recommended_law(section, row.wind_speed) == &row},
          {"beam_rms_mdeg", number(row.beam_rms / millidegree)},
          {"climate_beam_rms_mdeg", optional_number(row.climate_rms, millidegree)},
          {"bands", std::move(bands)},
          {"budgets", std::move(budgets)},
          {"gains_as_written", std::move(gains)},
          {"limits", limits_json(tuning)},
          {"design", row.stable() ? design_json(row.design) : Json(nullptr)},
          {"ensemble", row.ensemble ? ensemble_json(*row.ensemble) : Json(nullptr)}};
}

Json tune_json(const TuneSection& section) {
  Json bands = Json::array();
  for (const auto& band : section.bands) {
    bands.push_back({{"name", band.name},
                     {"frequency_Hz", band.frequency},
                     {"beamwidth_mdeg", band.beamwidth / millidegree},
                     {"illumination", text_or_null(band.illumination)}});
  }
  Json budgets = Json::array();
  for (const auto& budget : section.budgets) {
    budgets.push_back({{"name", budget.name},
                       {"band", budget.band},
                       {"convention", budget.convention},
                       {"rms_mdeg", budget.rms / millidegree},
                       {"wind_speed_m_per_s", optional_number(budget.wind_speed)}});
  }
  Json laws = Json::array();
  for (const auto& row : section.laws) laws.push_back(law_json(section, row));
  Json shortfalls = Json::array();
  for (const auto& one : section.shortfalls) {
    shortfalls.push_back({{"infeasible", one.infeasible}, {"closest", one.closest}});
  }
  Json json{{"structures", section.structures},
            {"wind_speeds_m_per_s", section.wind_speeds},
            {"wind_model", plant::to_string(section.wind_model)},
            {"goals", goals_json(section)},
            {"bands", std::move(bands)},
            {"budgets", std::move(budgets)},
            {"supply_wind_speed_m_per_s", number(section.supply_wind_speed)},
            {"ensemble_source", to_string(section.ensemble_source)},
            {"ensemble_members", section.ensemble_size},
            {"starts", section.starts},
            {"laws", std::move(laws)},
            {"not_run", section.not_run_texts()},
            {"shortfalls", std::move(shortfalls)}};
  if (section.wind_mast) json["wind_mast"] = mast_json(*section.wind_mast);
  return json;
}

}  // namespace boresight::app
