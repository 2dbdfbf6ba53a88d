#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/commissioning_records.hpp>
#include <boresight/design/commissioning/ratio_band.hpp>
#include <boresight/identification/records/drive_record.hpp>

namespace boresight::design {

/// A quantity by which two records of the drive are compared.
enum class ComparedQuantity {
  rate_error,     // motor rate less its command, rad/s
  motor_rate,     // rad/s
  torque,         // of all motors by their pressures, N m
  valve_command,  // rad/s
};
std::string_view to_string(ComparedQuantity quantity);
std::string_view unit_of(ComparedQuantity quantity);

struct QuantityComparison {
  ComparedQuantity quantity = ComparedQuantity::motor_rate;
  /// Reason why it could not be compared; empty if it was.
  std::string not_compared;
  RecordComparison comparison;
};

/// Compares the quantities that both records have, before and after a change of the controller.
/// @throws InvalidInput as compare_records.
std::vector<QuantityComparison> compare_drive_records(
    const identification::DriveRecord& before, const identification::DriveRecord& after,
    const identification::DriveKnowledge& knowledge);

/// The ratio predicted by the first and last stage of a plan for the design wind, with its range
/// over the plants. None where the plan does not begin with the gains found, a plant is unstable
/// with them, or the quantity is not predicted.
std::optional<RatioBand> predicted_ratio(const CommissioningPlan& plan, ComparedQuantity quantity);

/// True if the measured ratio over all frequencies and the prediction overlap.
bool agrees(const RecordComparison& measured, const RatioBand& predicted);

}  // namespace boresight::design
