#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning_check.hpp>
#include <boresight/design/commissioning/oil_flow.hpp>
#include <boresight/design/commissioning/plant_band.hpp>
#include <boresight/design/commissioning/stage_quantity.hpp>

namespace boresight::design {

/// The loop that a stage of commissioning changes, in the order of the work.
enum class StageKind {
  as_found,           // no change: the antenna with its present gains
  rate_loop,          // rate path, the position loop open
  pressure_feedback,  // pressure path, the position loop open
  position_loop,      // position path
  compliance,         // compliance path
  output,             // a state space: its whole output
  feedforward,        // rate and acceleration of the commanded motion
};
std::string_view to_string(StageKind kind);

struct CommissioningOptions {
  /// Largest factor, up or down, on any gain from one stage to the next; above 1.
  double largest_step = 2.0;
  /// Upper limit of Ms on any plant at an intermediate stage (the last has the design's own).
  double sensitivity_limit = 2.5;
  /// |S| at which a stage must be aborted.
  double abort_peak = 3.0;
  /// Measurement allowance beyond the band of the plants before a stage is aborted: a fraction of
  /// the step for an overshoot, a factor for an rms.
  double overshoot_allowance = 0.05;
  double rms_allowance = 1.2;
  /// Of the intervals over the plants.
  double confidence = 0.99;
  unsigned threads = 1;
  /// Polled before every stage; true ends the work (@throws Interrupted).
  std::function<bool()> stop = {};
  /// Called with the numbers of stages done and in total.
  std::function<void(std::size_t, std::size_t)> progress = {};
};

/// Limits beyond which the stage is reversed. Each is the end of the band over the plants plus the
/// measurement allowance, or an earlier value. The earlier value is that of the worst plant with
/// its loop gain raised until Ms reaches the abort peak. It applies where it exceeds the band by
/// half of the allowance or more.
struct AbortLimits {
  double overshoot = 0.0;         // fraction of the step
  double calm_valve_rms = 0.0;    // rad/s, in still air
  double calm_encoder_rms = 0.0;  // rad of motor; NaN with the position loop open
  /// Factor on the loop gain (kr, or kp once the position loop is closed) at which the worst plant
  /// reaches the abort peak; infinity if a factor of 8 does not.
  double gain_reserve = 0.0;
  std::string worst_plant;  // the plant nearest to the abort peak
};

/// Predictions for one stage. At the motor, as StageObservation.
struct StageExpectation {
  std::size_t plants = 0, stable = 0;
  PlantBand peak, crossover, rise_time, overshoot, settling_time, largest_demand, largest_torque;
  PlantBand calm_encoder, calm_tachometer, calm_torque, calm_valve;
  PlantBand windy_encoder, windy_tachometer, windy_torque, windy_valve;
  PlantBand boresight_rms, move_error, valve_per_rate, oil_stiffness;

  /// True if every plant is stable in this stage; only the present gains may fail this.
  bool all_stable() const { return stable == plants; }
};

/// The closed loop from the stage's command to what is recorded of it (StageObserver::response).
/// Empty where a plant is unstable.
struct StageBode {
  std::vector<double> frequency;       // rad/s
  std::vector<PlantBand> gain, phase;  // phase in rad, without jumps of a turn
};

struct CommissioningStage {
  StageKind kind = StageKind::as_found;
  int step = 0, steps = 0;  // index among the stages of its kind, from 1; their number
  StageController controller;
  StageExpectation expected;
  StageBode bode;
  AbortLimits abort;
  /// By experiment_effects, which plan_commissioning leaves out; empty: what is measured is
  /// compared with the linear plants.
  std::vector<ExperimentEffect> effects;
  std::optional<FlowModel> flow;  // of the nonlinear antenna; none: torque is not evaluated
};

/// The stages from the antenna's present gains to the chosen controller.
struct CommissioningPlan {
  std::vector<CommissioningStage> stages;  // the first is as found, where known
  /// Set where no gains were given, or none from which the controller can be reached. The plan then
  /// starts from the controller's own gains without pressure feedback and compliance compensation.
  /// The gains of rate and position path and the position integral's corner are divided by this
  /// factor; the rate gain only if `rate_detuned`.
  std::optional<double> detuning;
  bool rate_detuned = false;
  /// Deviations of the plan from the options, one sentence each.
  std::vector<std::string> remarks;
  double largest_step = 0.0;  // the factor applied; smaller than requested where that was too large

  /// Ms on any plant at any stage except the one as found; 0 without stages.
  double largest_peak() const;
};

/// Plans stages from `found` (none: not known) to `target`. Gains follow straight lines in their
/// logarithms, each in one direction only, by at most the largest step. Blocks that `found` does
/// not have start with no effect (corners at their bounds) or, with a path of their own, at a
/// quarter of the target's gain.
/// The order is: the rate path with the position loop open, as far as every plant allows without
/// pressure feedback; then pressure feedback, alternately with the rate path where that is limited
/// by damping. Then the position loop is closed at the gains found (halved until every plant
/// allows) and raised; then compliance compensation, then feedforward.
/// A state space has no loops to close one by one: it takes over at the least factor on its output
/// that can be raised to 1 in such steps, a quarter or the next step below it at the lowest. Its
/// stages have feedforward: it reads tachometer and torque about the commanded motion.
/// Every stage is stable by eigenvalues on the problem's plant and every member, with Ms at most
/// `sensitivity_limit` (or the target's own, if larger).
/// The plan does not depend on the number of threads. Cost: some 20 ms per stage and plant.
/// @throws InvalidInput for options out of range, no members, and as control::validate;
/// InfeasibleRequirement where the target itself is unstable on a plant, or no such path was found
/// with steps down to the fourth root of the largest, stating where it ended.
CommissioningPlan plan_commissioning(const TrackingProblem& problem,
                                     const std::vector<EnsembleMember>& members,
                                     const std::optional<control::Controller>& found,
                                     const control::Controller& target, const CommandedMove& move,
                                     const CommissioningOptions& options = {});

}  // namespace boresight::design
