#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning_check.hpp>

namespace boresight::design {

/// What a stage of commissioning changes. Their order is that of the work.
enum class StageKind {
  as_found,           // nothing: the antenna as it runs now
  rate_loop,          // rate path, the position loop open
  pressure_feedback,  // pressure path, the position loop open
  position_loop,      // position path
  compliance,         // compliance path
  feedforward,        // the commanded motion's own rate and acceleration
};
std::string_view to_string(StageKind kind);

struct CommissioningOptions {
  /// Largest factor, up or down, on any gain from one stage to the next; above 1.
  double largest_step = 2.0;
  /// Largest |S| on any plant at a stage on the way (the last has the design's own).
  double sensitivity_limit = 2.5;
  /// |S| at which a stage is to be given up.
  double abort_peak = 3.0;
  /// What is allowed for measuring beyond the band of the plants before a stage is given up: of
  /// the step for an overshoot, a factor for an rms.
  double overshoot_allowance = 0.05;
  double rms_allowance = 1.2;
  /// Of the intervals over the plants.
  double confidence = 0.99;
  unsigned threads = 1;
  /// Asked before every stage; true ends the work (@throws Interrupted).
  std::function<bool()> stop = {};
  /// Called with stages worked out and all.
  std::function<void(std::size_t, std::size_t)> progress = {};
};

/// A quantity over the plants that may be the true one.
struct PlantBand {
  double nominal = 0.0;  // on the problem's own
  double least = 0.0, largest = 0.0;
  /// Interval in which one more plant's value lies with the confidence asked for, by the normal
  /// distribution with the plants' mean and scatter (Student's prediction interval), of the
  /// logarithms where all are positive; not within the plants' own least and largest, not below 0.
  double lower = 0.0, upper = 0.0;
};

/// Beyond any of these: back to the stage before. Each is where the band over the plants ends, with
/// the allowance for measuring, or earlier: what the worst plant would show with its loop gain
/// raised until the peak of S is the one to give up at, where that lies beyond the band by half of
/// the allowance or more.
struct AbortLimits {
  double overshoot = 0.0;          // share of the step
  double still_valve_rms = 0.0;    // rad/s, in still air
  double still_encoder_rms = 0.0;  // rad of motor; NaN with the position loop open
  /// Factor on the loop gain (kr, or kp once the position loop is closed) that takes the worst
  /// plant to the peak at which to give up; infinity where 8 times does not.
  double gain_reserve = 0.0;
  std::string worst_plant;  // the one nearest to it
};

/// What is to be expected in one stage. At the motor, as StageObservation.
struct StageExpectation {
  std::size_t plants = 0, stable = 0;
  PlantBand peak, crossover, rise_time, overshoot, settling_time, largest_demand, largest_torque;
  PlantBand still_encoder, still_tachometer, still_torque, still_valve;
  PlantBand windy_encoder, windy_tachometer, windy_torque, windy_valve;
  PlantBand beam_rms, move_error;

  /// Whether every plant can do what the stage asks for: only the gains as found may not.
  bool all_stable() const { return stable == plants; }
};

struct CommissioningStage {
  StageKind kind = StageKind::as_found;
  int step = 0, steps = 0;  // number among those of its kind, from 1
  StageLaw law;
  StageExpectation expected;
  AbortLimits abort;
};

/// From where the antenna is to the law chosen for it.
struct CommissioningPlan {
  std::vector<CommissioningStage> stages;  // the first is as found where that is known
  /// Where no gains were given (or none from which this law can be reached): what the plan starts
  /// from are the law's own without pressure feedback and compliance compensation, the gains of
  /// rate and position path and the position integral's corner divided by this factor; the rate
  /// gain only if `rate_detuned`.
  std::optional<double> detuning;
  bool rate_detuned = false;
  /// What the plan had to do otherwise than asked, a sentence each.
  std::vector<std::string> remarks;
  double largest_step = 0.0;  // the factor kept to; smaller than asked for where that was too much

  /// Of |S| on any plant at any stage but that as found; 0 without stages.
  double largest_peak() const;
};

/// Stages from `found` (nothing: not known) to `target`. Gains go along straight lines in their
/// logarithms, each in one direction only, by no more than the largest step; blocks that `found`
/// does not have begin where they do nothing (corners at their bounds) or, with a path of their
/// own, at a quarter of the target's gain. First the rate path with the position loop open, as far
/// as every plant allows without pressure feedback; then pressure feedback, the rate path following
/// where it must wait for it; then the position loop is closed at the gains found (halved until
/// every plant allows) and raised; then compliance compensation, then feedforward. Every stage is
/// stable by eigenvalues on the problem's plant and every member, with peaks of S no larger than
/// `sensitivity_limit` (than the target's own, if that is larger).
/// The plan is the same for any number of threads. Cost: some 20 ms a stage and plant.
/// @throws InvalidInput for options out of range, no members, and as control::validate(law);
/// InfeasibleRequirement where the target itself is unstable on a plant or no such path was found
/// with steps down to the fourth root of the largest, saying where it ended.
CommissioningPlan plan_commissioning(const TrackingProblem& problem,
                                     const std::vector<EnsembleMember>& members,
                                     const std::optional<control::ControlLaw>& found,
                                     const control::ControlLaw& target, const CommandedMove& move,
                                     const CommissioningOptions& options = {});

/// The band of a quantity's values over the plants; values that are not finite make it NaN.
/// @throws InvalidInput for fewer than 3 values or a confidence outside (0, 1).
PlantBand plant_band(double nominal, const std::vector<double>& values, double confidence);

}  // namespace boresight::design
