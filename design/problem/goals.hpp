#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::design {

/// Robustness against limit cycles at rest. In small motions dry friction acts like a large viscous
/// friction (plant::equivalent_friction). With each of these slopes instead of the plant's viscous
/// friction, the problem's own plant must be stable and |S| at the valve command within the limit.
struct Standstill {
  double sensitivity_peak = 3.0;
  std::vector<double> friction = {};  // N m s/rad; see standstill_friction

  /// A motion across an edge between two codes of the encoder.
  struct Edge {
    double friction = 0.0;      // N m s/rad, instead of the plant's viscous friction
    double encoder_gain = 1.0;  // by which the reading counts more than the angle
  };
  /// See encoder_edges and breakaway_stiffness. Only the refinement of a state space uses them
  /// (pointing_limit).
  std::vector<Edge> edges = {};
  std::optional<double> breakaway_stiffness = std::nullopt;  // N m/rad of motor
  /// Amplitude (rad of motor) of the oscillation with each friction. A conditional integral counts
  /// with its describing function there (control::set_linear_equivalent). Empty: as the linear one.
  std::vector<double> amplitude = {};
};

/// The constraints of a design. Those per break are in the order of control::loop_breaks.
struct Constraints {
  /// Largest |S| allowed (Ms).
  std::array<double, 3> sensitivity_peak{2.0, 2.0, 2.0};
  double control_effort = 0.6;  // rad/s rms of noise-driven valve demand
  /// Smallest gain margin: factor, up or down, by which the gain may change; above 1.
  std::array<std::optional<double>, 3> gain_margin{};
  /// Smallest phase margin: angle to -1 (rad), within (0, pi).
  std::array<std::optional<double>, 3> phase_margin{};
  /// Lowest bandwidth: frequency (rad/s) at which the position loop's |S| reaches 1/sqrt(2).
  std::optional<double> bandwidth = std::nullopt;
  /// Largest valve demand (rad/s) and motor torque (N m) in the problem's wind: the value in the
  /// mean wind plus `crest_factor` times the rms in its gusts.
  std::optional<double> gust_demand = std::nullopt;
  std::optional<double> gust_torque = std::nullopt;
  double crest_factor = 3.5;
  /// Largest error of the encoder at rest in the problem's mean wind (rad at the sky): the leakage
  /// flow that holds the mean torque over control::static_encoder_gain. 0 asks for an integral.
  std::optional<double> static_encoder_error = std::nullopt;
  std::optional<Standstill> standstill = std::nullopt;

  bool ask_for_gusts() const { return gust_demand.has_value() || gust_torque.has_value(); }
  bool ask_for_margins() const;
};

/// @throws InvalidInput for a limit that no loop or every loop meets: Ms not above 1, a gain margin
/// not above 1, a phase margin outside (0, pi), a negative static error, any other limit or a
/// friction at standstill not positive and finite.
void validate(const Constraints& goals);

/// The objective of a tuning: a boresight rms computed from the rms on each plant.
enum class ObjectiveKind {
  nominal,     // of the problem's own plant
  expected,    // root of the mean variance over the ensemble
  worst_case,  // the largest over the ensemble
  quantile,    // smallest value that a fraction of the ensemble stays below
};
std::string_view to_string(ObjectiveKind kind);

struct Objective {
  ObjectiveKind kind = ObjectiveKind::nominal;
  double quantile = 0.95;  // fraction of the members, within (0, 1]
};

enum class GoalKind {
  sensitivity_peak,
  control_effort,
  gain_margin,
  phase_margin,
  bandwidth,
  gust_demand,
  gust_torque,
  static_encoder_error,
  standstill_peak,
};
inline constexpr std::size_t goal_kinds = 9;
std::string_view to_string(GoalKind kind);

/// One normalised constraint (value/limit) of one loop.
struct NormalisedConstraint {
  GoalKind kind = GoalKind::sensitivity_peak;
  std::optional<control::LoopBreak> loop_break;
  double frequency = 0.0;  // rad/s; 0 where the quantity covers all frequencies
  /// Value/limit for an upper limit, limit/value for a lower limit. Met up to 1.
  double ratio = 0.0;
  /// d ln(ratio) / d ln(gain).
  std::array<double, control::max_gains> log_gradient{};
};

/// "sensitivity peak at valve command, 0.84 Hz".
std::string describe(const NormalisedConstraint& goal);

/// Loads of the mean wind at the motor, to which gusts are added.
struct MeanWindLoad {
  double torque = 0.0;  // N m
  double demand = 0.0;  // rad/s, leakage flow at that torque
};

/// Appends the normalised constraints except margins and bandwidth, from one evaluation.
void append_normalised_constraints(const control::LoopEvaluation& evaluation,
                                   const Constraints& goals, const MeanWindLoad& mean,
                                   std::vector<NormalisedConstraint>& ratios);
/// Encoder error (rad at the sky) that a leakage flow (MeanWindLoad::demand) leaves at rest: over
/// control::static_encoder_gain and the gear ratio. Of a conditional integral its width: within it
/// the integral keeps whatever the last motion left.
double static_encoder_error(const control::Controller& controller, double demand,
                            double gear_ratio);
/// The ratio of Constraints::static_encoder_error, to that error. A limit below 1e-12 rad counts as
/// that.
NormalisedConstraint static_error_constraint(const control::Controller& controller, double demand,
                                             double gear_ratio, double limit);
/// The error (rad at the sky) of such a constraint of that limit.
double found_static_error(const NormalisedConstraint& constraint, double limit);
/// Appends the constraint of Constraints::standstill, from one evaluation with its friction.
void append_standstill_peaks(const control::LoopEvaluation& evaluation,
                             const Standstill& standstill,
                             std::vector<NormalisedConstraint>& ratios);
/// Appends the constraints on margins and bandwidth, where specified, from the loop gain. A
/// bandwidth below the grid counts as the grid's first frequency.
void append_margin_ratios(const control::LoopChannels& channels, double delay,
                          const control::Controller& controller, const Constraints& goals,
                          std::vector<NormalisedConstraint>& ratios);

}  // namespace boresight::design
