#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>

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
};
std::string_view to_string(StageQuantity quantity);

/// The quantities that show whether a stage is as predicted, in the order of the work: of a step
/// rise time, overshoot and settling time; the rms of valve command, and of tachometer (position
/// loop open) or encoder error; with feedforward the error of the move instead of the step's. Where
/// the rate changes, the valve command that it takes.
/// Without those that are not predicted on every plant; none where a plant is unstable.
std::vector<StageQuantity> measured_quantities(const CommissioningStage& stage);

double value_of(StageQuantity quantity, const StageObservation& seen);
const PlantBand& expected_of(StageQuantity quantity, const StageExpectation& expected);
/// None where the quantity has no limit of its own.
std::optional<double> abort_limit(StageQuantity quantity, const CommissioningStage& stage);

/// What the prediction of a step on the linear plant is good for: an overshoot to a fraction of the
/// step, a time relative.
inline constexpr double overshoot_resolution = 0.02;
inline constexpr double time_resolution = 0.03;
/// And the steady valve command for a rate, relative: the orifices' load is not linear.
inline constexpr double valve_resolution = 0.05;

/// The interval in which a measured value passes: the band over the plants; of an rms, whose sensor
/// noise is known less well, `rms_allowance` times wider on both sides; of all others but the error
/// of a move wider by the resolutions above. It ends at the abort limit.
struct PassInterval {
  double lower = 0.0, upper = 0.0;
};
PassInterval pass_interval(StageQuantity quantity, const CommissioningStage& stage,
                           double rms_allowance);

enum class StageVerdict {
  passes,   // within the interval
  outside,  // find the cause before the next stage
  abort,    // beyond the abort limit, or unstable: back to the previous stage
};
std::string_view to_string(StageVerdict verdict);

/// The verdict on a value with its standard uncertainty: two of them count in its favour.
StageVerdict verdict_on(StageQuantity quantity, double value, double uncertainty,
                        const CommissioningStage& stage, double rms_allowance);

/// The verdict on all quantities that a plant shows in a stage: the worst of them.
struct StageEvaluation {
  StageVerdict verdict = StageVerdict::passes;
  bool stable = true;
  std::optional<StageQuantity> worst;  // of a verdict that is not passes; none: unstable
  std::vector<StageQuantity> outside;  // all that do not pass; none of an unstable loop
};
StageEvaluation evaluated(const StageObservation& seen, const CommissioningStage& stage,
                          double rms_allowance);

}  // namespace boresight::design
