#pragma once

#include <string_view>

namespace boresight::design {

/// What is measured in a stage of commissioning.
enum class StageQuantity {
  rise_time,        // s, 10 % to 90 % of a step
  overshoot,        // fraction of the step
  settling_time,    // s, into 5 %
  calm_valve,       // rad/s, rms in still air, as those below
  calm_tachometer,  // rad/s
  calm_encoder,     // rad of motor
  move_error,       // rad of motor, largest encoder error of the move
  valve_per_rate,   // 1, change of the steady valve command over that of the motor rate
  flow_per_rate,    // 1, the same of the valve's flow at the recorded load (valve_flow)
  oil_stiffness,    // N m/rad, by torque, rate and flow (oil_spring)
};
std::string_view to_string(StageQuantity quantity);
/// Of the rms in still air.
bool is_rms(StageQuantity quantity);

/// What the nonlinear antenna adds to the linear plant's prediction of a quantity in the stage's
/// experiment: a factor, of an overshoot a term. `lower` to `upper` are those of friction torques
/// within friction_allowance of the stated ones. NaN where the experiment does not show it.
struct ExperimentEffect {
  StageQuantity quantity = StageQuantity::rise_time;
  double nominal = 1.0, lower = 1.0, upper = 1.0;
};

/// Relative uncertainty of the case's friction torques, which change with oil temperature, wear and
/// place.
inline constexpr double friction_allowance = 0.3;

}  // namespace boresight::design
