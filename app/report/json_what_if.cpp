#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <boresight/app/report/json_what_if.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

Json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

Json list(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(rounded(value, 6));
  return json;
}

}  // namespace

Json what_if_json(const WhatIfTable& table) {
  Json rms = Json::array(), states = Json::array(), bands = Json::array(), budgets = Json::array();
  for (const double value : table.beam_rms) rms.push_back(rounded(value / millidegree, 5));
  for (const auto state : table.states) states.push_back(static_cast<int>(state));
  for (const auto& band : table.bands) {
    bands.push_back({{"name", band.name},
                     {"frequency_Hz", band.frequency},
                     {"beamwidth_mdeg", rounded(band.beamwidth / millidegree, 6)}});
  }
  for (const auto& budget : table.budgets) {
    budgets.push_back({{"name", budget.name},
                       {"band", budget.band},
                       {"rms_mdeg", rounded(budget.rms / millidegree, 5)}});
  }
  return {{"structures", table.structures},
          {"flywheel_disks_1", list(table.disks)},
          {"leakage_rates_per_s", list(table.leakage_rates)},
          {"friction_slopes_N_m_s_per_rad", list(table.friction_slopes)},
          {"wind_speeds_m_per_s", list(table.wind_speeds)},
          {"start",
           {{"flywheel_disks_1", rounded(table.disks_as_built, 6)},
            {"leakage_rate_per_s", rounded(table.leakage_rate, 6)},
            {"friction_slope_N_m_s_per_rad", rounded(table.friction_slope, 6)},
            {"wind_speed_m_per_s", rounded(table.wind_speed, 6)}}},
          {"friction_slope_at_tracking_rate_N_m_s_per_rad", rounded(table.tracking_friction, 4)},
          {"bands", std::move(bands)},
          {"budgets", std::move(budgets)},
          {"beam_rms_mdeg", std::move(rms)},
          {"states_1", std::move(states)}};
}

}  // namespace boresight::app
