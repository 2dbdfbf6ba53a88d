#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>

namespace boresight::design {

/// The quantities that show whether a stage is as predicted, in the order of the work: of a step
/// rise time, overshoot and settling time, with feedforward the error of the move instead; where
/// the rate changes, the valve command that it takes, and with a flow model its flow; with that the
/// oil stiffness; the rms of valve command, and of tachometer (position loop open) or encoder
/// error. Without those that are not predicted on every plant, or that the nonlinear antenna does
/// not show; none where a plant is unstable.
std::vector<StageQuantity> measured_quantities(const CommissioningStage& stage);

double value_of(StageQuantity quantity, const StageObservation& seen);
const PlantBand& expected_of(StageQuantity quantity, const StageExpectation& expected);
/// The nominal antenna's, with the stage's effects.
double expected_value(StageQuantity quantity, const CommissioningStage& stage);
/// A prediction of the linear plant with the stage's effect on this quantity.
double with_effect(StageQuantity quantity, double linear, const CommissioningStage& stage);
/// None where the quantity has no limit of its own. With the stage's effect on an overshoot, where
/// that raises it.
std::optional<double> abort_limit(StageQuantity quantity, const CommissioningStage& stage);

/// What the prediction of a step on the linear plant is good for: an overshoot to a fraction of the
/// step, a time relative.
inline constexpr double overshoot_resolution = 0.02;
inline constexpr double time_resolution = 0.03;
/// And the steady valve command for a rate, relative: the orifices' load is not linear.
inline constexpr double valve_resolution = 0.05;
/// And the oil stiffness, relative, whose record leaves out lines and the valve's dynamics.
inline constexpr double stiffness_resolution = 0.05;

/// The interval in which a measured value passes: the band over the plants; of an rms, whose sensor
/// noise is known less well, `rms_allowance` times wider on both sides; of all others but the error
/// of a move wider by the resolutions above. With the stage's effects, from the least to the
/// largest. It ends at the abort limit.
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

/// The verdict on all quantities that a linear plant shows in a stage, without the stage's effects:
/// the worst of them.
struct StageEvaluation {
  StageVerdict verdict = StageVerdict::passes;
  bool stable = true;
  std::optional<StageQuantity> worst;  // of a verdict that is not passes; none: unstable
  std::vector<StageQuantity> outside;  // all that do not pass; none of an unstable loop
};
StageEvaluation evaluated(const StageObservation& seen, const CommissioningStage& stage,
                          double rms_allowance);

}  // namespace boresight::design
