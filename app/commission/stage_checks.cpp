#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/commission/stage_checks.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/code/computer_signals.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::app {

using design::StageQuantity;

PlantUnits plant_units(const io::Case& antenna, const design::Mission& mission) {
  PlantUnits units;
  units.gear_ratio = plant::gear_ratio(mission.antenna);
  if (!antenna.simulation) return units;
  const io::CaseSignals signals = io::computer_signals(antenna, mission, false);
  units.valve = signals.signals.valve_command.scale;
  units.valve_unit = signals.signals.valve_command.unit;
  units.tachometer = signals.signals.tachometer.scale;
  units.tachometer_unit = signals.signals.tachometer.unit;
  units.valve_by_default = std::ranges::any_of(signals.descriptions, [](const auto& one) {
    return one.signal == "valve command" && !one.stated;
  });
  return units;
}

QuantityUnit unit_of(StageQuantity quantity, const PlantUnits& units) {
  switch (quantity) {
    case StageQuantity::rise_time:
    case StageQuantity::settling_time:
      return {"s", 1.0};
    case StageQuantity::overshoot:
      return {"%", 100.0};
    case StageQuantity::calm_valve:
      return {units.valve_unit + " rms", units.valve};
    case StageQuantity::calm_tachometer:
      return {units.tachometer_unit + " rms", units.tachometer};
    case StageQuantity::calm_encoder:
      return {"mdeg rms", 1.0 / (units.gear_ratio * millidegree)};
    case StageQuantity::move_error:
      return {"mdeg", 1.0 / (units.gear_ratio * millidegree)};
    case StageQuantity::oil_stiffness:
      return {"N.m/rad", 1.0};
    case StageQuantity::valve_per_rate:
    case StageQuantity::flow_per_rate:
      break;
  }
  return {units.valve_unit + " per " + units.tachometer_unit, units.valve / units.tachometer};
}

std::vector<StageCheck> stage_checks(const design::CommissioningStage& stage,
                                     const PlantUnits& units, double rms_allowance) {
  std::vector<StageCheck> checks;
  for (const StageQuantity quantity : measured_quantities(stage)) {
    const auto [unit, factor] = unit_of(quantity, units);
    const design::PassInterval interval = pass_interval(quantity, stage, rms_allowance);
    StageCheck check{quantity,
                     unit,
                     factor * expected_value(quantity, stage),
                     factor * interval.lower,
                     factor * interval.upper,
                     abort_limit(quantity, stage)};
    if (check.abort_above) *check.abort_above *= factor;
    checks.push_back(std::move(check));
  }
  return checks;
}

std::string checked_number(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  // What is next to nothing has no digits of its own.
  constexpr double least = 1e-4;
  const int decimals =
      size >= least ? std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6) : 0;
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace boresight::app
