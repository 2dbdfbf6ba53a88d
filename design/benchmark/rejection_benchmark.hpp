#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/loops/state_space_controller_course.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// What is measured and how (docs/benchmark-protocol.md). A change of any definition, grid or list
/// is a new number: scores of different numbers do not compare.
inline constexpr int rejection_protocol = 2;

/// Mean wind speeds of the protocol's ladder, m/s.
inline constexpr std::array rejection_speeds{2.0, 5.0, 8.0, 10.0, 12.0, 15.0, 20.0};

/// A way the wind meets the dish.
struct WindAttitudeCoefficient {
  std::string name;
  double torque_coefficient = 0.0;
};

struct RejectionOptions {
  /// Beside the problem's own torque coefficient, which is always judged.
  std::vector<WindAttitudeCoefficient> attitudes;
  std::vector<EnsembleMember> members;
  std::vector<double> budgets;  // beam rms an axis, rad at the sky
  /// s, of the best sampled controller that scores are held against; 0: what the delay is one and a
  /// half of. A sampled controller has its own.
  double sample_time = 0.0;
  unsigned threads = 1;
  /// Asked between parts; true leaves the rest out.
  std::function<bool()> stop = {};
};

/// One loop cut.
struct BreakScore {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  /// None where the controller has no such loop.
  std::optional<control::Margins> margins;
};

/// |beam / torque| at the sky by the torque at the antenna's axis.
struct CompliancePoint {
  double frequency = 0.0;   // Hz
  double compliance = 0.0;  // rad/(N m)
};

/// One rung of the ladder. Rms over the problem's band, rad at the sky, one axis.
struct WindScore {
  std::string attitude;  // empty: the problem's own coefficient
  double torque_coefficient = 0.0;
  plant::WindModel model = plant::WindModel::coherence;
  double mean_speed = 0.0;  // m/s
  double torque_rms = 0.0;  // N m at the antenna's axis
  double wind_rms = 0.0;
  double beam_rms = 0.0;  // with the sensors' noise
};

/// The controller on one plant that may be the true one.
struct RejectionMember {
  std::string name;
  bool stable = false;
  bool within_goals = false;
  double beam_rms = 0.0;                      // rad at the sky; NaN if unstable, as below
  double valve_effort = 0.0;                  // rad/s
  std::array<double, 3> sensitivity_peaks{};  // NaN where there is no such loop
};

struct RejectionEnsemble {
  std::vector<RejectionMember> members;
  int stable = 0;
  int within_goals = 0;
  double largest_rms = 0.0;  // of the stable ones
};

/// The best that any controller could do, and what no loop sees, at the design wind.
struct RejectionReference {
  double encoder_held_rms = 0.0;  // rad: bending with the encoder perfectly still
  /// Lower bounds of any linear sampled controller (design/limits/pointing_limit.hpp): at the
  /// goal's valve effort and at this controller's own. None where a sensor has no noise.
  std::optional<double> least_rms, least_rms_at_own_effort;
};

/// A score sheet. All at the sky and at the antenna's axis: rad, N m.
struct RejectionScore {
  bool stable = false;
  double abscissa = 0.0;  // 1/s, of the slowest pole, dead time exact
  /// With the position loop open; none where the controller has no rate loop.
  std::optional<bool> rate_loop_stable;
  // Empty unless stable.
  control::CourseScore step, impulse;    // per N m, per N m s
  control::PeakGain worst;               // rad/(N m), frequency in rad/s
  double static_compliance = 0.0;        // rad/(N m)
  double encoder_held_compliance = 0.0;  // the same with the encoder perfectly still: the bending
  std::vector<CompliancePoint> compliance;
  std::array<BreakScore, 3> breaks;
  double noise_rms = 0.0;     // rad
  double valve_effort = 0.0;  // rad/s of motor
  /// At the problem's wind: torque, and the beam by spectrum and, independently, by Lyapunov
  /// equations with the wind's shaping filter.
  WindScore design_wind;
  double lyapunov_rms = 0.0;
  std::vector<WindScore> winds;
  std::vector<double> budget_speeds;  // m/s; 0 and infinity as wind_speed_limit
  std::optional<RejectionReference> reference;
  std::optional<RejectionEnsemble> ensemble;
  std::vector<std::string> left_out;  // parts that stop() left out
};

/// Scores a controller (control::antenna_state_space_controller) on a problem by the protocol. An
/// unstable closed loop is a result: nothing but its poles is set. The same for any number of
/// threads. Some 0.1 s, and 1 s for the reference and 0.02 s a member.
/// @throws InvalidInput as antenna_state_space_controller, validate(goals); NumericalFailure as
/// control::ControlledCourse, and if spectrum and Lyapunov equations differ by more than 2 %.
RejectionScore rejection_benchmark(const TrackingProblem& problem, const HardGoals& goals,
                                   const plant::StateSpace& controller,
                                   const RejectionOptions& options = {});

/// The frequencies (Hz) of the compliance curve: 10^(k/40) from 1 mHz to 25 Hz.
std::vector<double> compliance_frequencies();

}  // namespace boresight::design
