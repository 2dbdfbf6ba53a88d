#include <cmath>

#include <boresight/design/commissioning/drive_record_comparison.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using identification::DriveKnowledge;
using identification::DriveRecord;
using identification::Signal;

std::vector<bool> both(const std::vector<bool>& one, const std::vector<bool>& other) {
  if (one.empty()) return other;
  std::vector<bool> result = one;
  for (std::size_t i = 0; i < other.size(); ++i) result[i] = result[i] && other[i];
  return result;
}

RecordedChannel channel_of(const Signal& signal, double sample_time) {
  return {signal.values, signal.valid, sample_time};
}

RecordedChannel torque_of(const DriveRecord& record, const DriveKnowledge& knowledge) {
  std::vector<bool> valid;
  for (const auto& signal : record.inlet_pressure) valid = both(valid, signal.valid);
  for (const auto& signal : record.outlet_pressure) valid = both(valid, signal.valid);
  return {identification::recorded_torque(record, knowledge), valid, record.sample_time};
}

RecordedChannel rate_error(const DriveRecord& record, const Signal& command) {
  return {record.motor_rate.values - command.values, both(record.motor_rate.valid, command.valid),
          record.sample_time};
}

QuantityComparison compared(ComparedQuantity quantity, const RecordedChannel& before,
                            const RecordedChannel& after) {
  QuantityComparison result{quantity, {}, {}};
  try {
    result.comparison = compare_records(before, after);
  } catch (const NumericalFailure& failure) {
    // Clipped too often; others may serve.
    result.not_compared = failure.what();
  }
  return result;
}

}  // namespace

std::string_view to_string(ComparedQuantity quantity) {
  switch (quantity) {
    case ComparedQuantity::rate_error:
      return "motor rate less its command";
    case ComparedQuantity::motor_rate:
      return "motor rate";
    case ComparedQuantity::torque:
      return "torque";
    case ComparedQuantity::valve_command:
      return "valve command";
  }
  return "";
}

std::string_view unit_of(ComparedQuantity quantity) {
  return quantity == ComparedQuantity::torque ? "N.m" : "rad/s";
}

std::vector<QuantityComparison> compare_drive_records(const DriveRecord& before,
                                                      const DriveRecord& after,
                                                      const DriveKnowledge& knowledge) {
  std::vector<QuantityComparison> result;
  if (before.rate_command && after.rate_command) {
    result.push_back(compared(ComparedQuantity::rate_error,
                              rate_error(before, *before.rate_command),
                              rate_error(after, *after.rate_command)));
  }
  result.push_back(compared(ComparedQuantity::motor_rate,
                            channel_of(before.motor_rate, before.sample_time),
                            channel_of(after.motor_rate, after.sample_time)));
  if (!before.inlet_pressure.empty() && !after.inlet_pressure.empty()) {
    result.push_back(compared(ComparedQuantity::torque, torque_of(before, knowledge),
                              torque_of(after, knowledge)));
  }
  if (before.valve_command && after.valve_command) {
    result.push_back(compared(ComparedQuantity::valve_command,
                              channel_of(*before.valve_command, before.sample_time),
                              channel_of(*after.valve_command, after.sample_time)));
  }
  return result;
}

std::optional<RatioBand> predicted_ratio(const CommissioningPlan& plan, ComparedQuantity quantity) {
  if (plan.stages.empty() || plan.stages.front().kind != StageKind::as_found) return std::nullopt;
  const auto ratio = [&](const PlantBand StageExpectation::*band) -> std::optional<RatioBand> {
    const PlantBand& before = plan.stages.front().expected.*band;
    const PlantBand& after = plan.stages.back().expected.*band;
    if (!std::isfinite(before.upper) || !std::isfinite(after.upper)) return std::nullopt;
    return RatioBand{after.nominal / before.nominal, after.lower / before.upper,
                     after.upper / before.lower};
  };
  switch (quantity) {
    case ComparedQuantity::motor_rate:
      return ratio(&StageExpectation::windy_tachometer);
    case ComparedQuantity::torque:
      return ratio(&StageExpectation::windy_torque);
    case ComparedQuantity::valve_command:
      return ratio(&StageExpectation::windy_valve);
    case ComparedQuantity::rate_error:
      break;
  }
  return std::nullopt;
}

bool agrees(const RecordComparison& measured, const RatioBand& predicted) {
  return measured.whole.lower <= predicted.upper && predicted.lower <= measured.whole.upper;
}

}  // namespace boresight::design
