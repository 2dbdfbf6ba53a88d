#pragma once

#include <optional>

#include <boresight/identification/records/servo_record.hpp>

namespace boresight::design {

/// What a record's torque, motor rate and valve command are related by.
struct FlowModel {
  double supply_torque = 0.0;   // N m, at the supply pressure less the return pressure
  double delay = 0.0;           // s from the valve command to its flow, hold included
  double tachometer_lag = 0.0;  // s from the motor rate to the recorded one
  double window = 0.0;          // s, some periods of the hydraulic mode
};

/// The no-load motor rate that the valve passes at the recorded load: u sqrt(1 - T/supply_torque),
/// T positive if it acts against the flow (H. E. Merritt, Hydraulic Control Systems, 1967, ch. 5).
/// Of a record with valve command and motor torque of the same length.
identification::Signal valve_flow(const identification::ServoRecord& record,
                                  const FlowModel& model);

struct OilSpring {
  double stiffness = 0.0;    // N m/rad
  double uncertainty = 0.0;  // standard
};

/// The oil spring that a record shows, by T' = a q - K w - lambda T with the flow q and the rate w,
/// all as late as the tachometer: integrated, each term less its moving average over the window, by
/// least squares over a, K and lambda. The friction is no part of it. The uncertainty is that of
/// residuals that are correlated over an eighth of the window. None without the three signals,
/// where a sample is not valid, and where the standard uncertainty exceeds a fifth of the
/// stiffness.
/// @pre delay and tachometer_lag are not negative.
std::optional<OilSpring> oil_spring(const identification::ServoRecord& record,
                                    const FlowModel& model);

}  // namespace boresight::design
