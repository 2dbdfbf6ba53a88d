#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/loops/state_space_controller_response.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Version of the protocol (docs/benchmark-protocol.md). It increases with every change of a
/// definition, grid or list; scores of different versions are not comparable.
inline constexpr int rejection_protocol = 4;

/// Mean wind speeds of the protocol's ladder, m/s.
inline constexpr std::array rejection_speeds{2.0, 5.0, 8.0, 10.0, 12.0, 15.0, 20.0};

/// A wind direction relative to the dish.
struct WindAttitudeCoefficient {
  std::string name;
  double torque_coefficient = 0.0;
};

struct RejectionOptions {
  /// In addition to the problem's own torque coefficient, which is always evaluated.
  std::vector<WindAttitudeCoefficient> attitudes;
  std::vector<EnsembleMember> members;
  std::vector<double> budgets;  // boresight rms per axis, rad at the sky
  /// s, of the best sampled controller with which scores are compared; 0: two thirds of the delay.
  /// A sampled controller uses its own sample time.
  double sample_time = 0.0;
  unsigned threads = 1;
  /// Polled between parts; true skips the rest.
  std::function<bool()> stop = {};
};

/// Score of one loop break.
struct BreakScore {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  /// None where the controller has no such loop.
  std::optional<control::Margins> margins;
};

/// |boresight / torque|: angle at the sky per torque at the antenna's axis.
struct CompliancePoint {
  double frequency = 0.0;   // Hz
  double compliance = 0.0;  // rad/(N m)
};

/// One wind speed of the ladder. Rms over the problem's band, rad at the sky, per axis.
struct WindScore {
  std::string attitude;  // empty: the problem's own coefficient
  double torque_coefficient = 0.0;
  plant::WindModel model = plant::WindModel::coherence;
  double mean_speed = 0.0;  // m/s
  double torque_rms = 0.0;  // N m at the antenna's axis
  double wind_rms = 0.0;
  double boresight_rms = 0.0;  // with the sensors' noise
};

/// The controller on one ensemble member.
struct RejectionMember {
  std::string name;
  bool stable = false;
  bool within_constraints = false;
  double boresight_rms = 0.0;                 // rad at the sky; NaN if unstable, as below
  double control_effort = 0.0;                // rad/s
  std::array<double, 3> sensitivity_peaks{};  // NaN where there is no such loop
};

struct RejectionEnsemble {
  std::vector<RejectionMember> members;
  int stable = 0;
  int within_constraints = 0;
  double largest_rms = 0.0;  // of the stable ones
};

/// Lower bounds on the rms of any controller, and the flexure beyond the encoder, in the design
/// wind.
struct RejectionReference {
  double flexure_rms = 0.0;  // rad: flexure beyond the encoder with the encoder at rest
  /// Lower bounds of any linear sampled controller (design/limits/pointing_limit.hpp): at the
  /// constraint's control effort and at this controller's own. None where a sensor has no noise.
  std::optional<double> min_rms, min_rms_at_own_effort;
};

/// A score sheet. All at the sky and at the antenna's axis: rad, N m.
struct RejectionScore {
  bool stable = false;
  double abscissa = 0.0;  // 1/s, of the slowest pole, dead time exact
  /// With the position loop open; none where the controller has no rate loop.
  std::optional<bool> rate_loop_stable;
  // Empty unless stable.
  control::ResponseScore step, impulse;  // per N m, per N m s
  control::PeakGain worst;               // rad/(N m), frequency in rad/s
  double static_compliance = 0.0;        // rad/(N m)
  double flexure_compliance = 0.0;       // the same with the encoder at rest: the flexure
  std::vector<CompliancePoint> compliance;
  std::array<BreakScore, 3> breaks;
  double noise_rms = 0.0;       // rad
  double control_effort = 0.0;  // rad/s of motor
  /// In the problem's wind: torque, and the boresight rms by spectrum. `lyapunov_rms`: the same,
  /// independently, by Lyapunov equations with the wind's shaping filter.
  WindScore design_wind;
  double lyapunov_rms = 0.0;
  std::vector<WindScore> winds;
  std::vector<double> budget_speeds;  // m/s; 0 and infinity as wind_speed_limit
  std::optional<RejectionReference> reference;
  std::optional<RejectionEnsemble> ensemble;
  std::vector<std::string> left_out;  // parts skipped by stop()
};

/// Scores a controller (control::antenna_state_space_controller) on a problem by the protocol. An
/// unstable closed loop gives a result with only its poles set. The result does not depend on the
/// number of threads. Takes some 0.1 s, plus 1 s for the reference and 0.02 s per member.
/// @throws InvalidInput as antenna_state_space_controller, validate(goals); NumericalFailure as
/// control::ClosedLoopResponse, and if spectrum and Lyapunov equations differ by more than 2 %.
RejectionScore rejection_benchmark(const TrackingProblem& problem, const Constraints& goals,
                                   const plant::StateSpace& controller,
                                   const RejectionOptions& options = {});

/// The frequencies (Hz) of the compliance curve: 10^(k/40) from 1 mHz to 25 Hz.
std::vector<double> compliance_frequencies();

}  // namespace boresight::design
