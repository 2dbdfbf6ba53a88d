#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::design {

/// A tuned loop as built: the nonlinear antenna with a sampled controller
/// (control::AntennaController) whose computation takes one sample time. All at the motor shaft.
struct SimulatedLoop {
  plant::NonlinearAntenna antenna;
  /// The linear plant of the design. Its viscous friction replaces the friction curve when that is
  /// switched off, and feedforward is computed from it.
  plant::AntennaPlant linear;
  control::Controller controller;
  double gear_ratio = 1.0;
  double sample_time = 0.02;  // s
  /// Densities, as in the linear design. Rounding to the steps below is part of it: a run adds the
  /// white noise that is missing to the same rms.
  control::SensorNoise noise;
  double encoder_resolution = 0.0;     // rad of motor, step of the converter; 0: none
  double tachometer_resolution = 0.0;  // rad/s
  bool feedforward = true;             // feedforward_of
  /// Fraction of the antenna's friction torque that is fed forward. The rest is its mismatch:
  /// friction changes with the oil's temperature and with wear.
  double friction_feedforward = 0.8;
  /// What the feedforward takes for the antenna's friction; the antenna's own if empty.
  std::optional<plant::FrictionCurve> stated_friction = std::nullopt;
  bool anti_windup = true;
};

/// The loop of a controller tuned on a problem. The problem provides its noise. The problem's delay
/// is one and a half sample times (computation and half a hold) and so gives the sample time.
/// Without converter steps.
SimulatedLoop make_simulated_loop(const TrackingProblem& problem,
                                  const plant::NonlinearAntenna& antenna,
                                  const control::Controller& controller);

/// Effects that the linear design neglects; each can be switched off separately:
///   friction       the curve and its bristles; off: the linear plant's viscous friction
///   limits         stroke, spool speed and command limit
///   quantisation   steps of encoder and tachometer; off: white noise of the same rms
///   orifice        off: flow proportional to the port's opening at any pressure; no make-up valves
///   gear           backlash; off: both halves always in contact
enum class Influence { friction, limits, quantisation, orifice, gear };
inline constexpr Influence influences[] = {Influence::friction, Influence::limits,
                                           Influence::quantisation, Influence::orifice,
                                           Influence::gear};
std::string_view to_string(Influence influence);

/// The feedforward of run_loop without these influences: control::plant_feedforward and
/// control::with_friction, whose curve replaces the plant's viscous friction, and the supply's
/// torque. Without friction it has the plant's viscous friction, without orifices no supply torque.
/// All zero if `feedforward` is false. @throws InvalidInput as its parts.
control::Feedforward feedforward_of(const SimulatedLoop& loop,
                                    std::span<const Influence> without = {});

/// True if the loop has the influence at all.
bool has(const SimulatedLoop& loop, Influence influence);

/// Reference trajectory and disturbance of a run, from t = 0 in steps of `interval`. The sample
/// time is a multiple of the interval.
struct ReferenceTrajectory {
  double interval = 0.0;                   // s
  Eigen::VectorXd reference;               // rad of motor
  Eigen::VectorXd reference_rate;          // rad/s
  Eigen::VectorXd reference_acceleration;  // rad/s2, from this step on
  Eigen::VectorXd wind_torque;             // N m at the motor
};

/// Number of samples of a duration (s), rounded.
Eigen::Index whole_samples(double duration, double sample_time);

/// A trajectory of `samples` sample times, each in `steps` steps. Its reference is the command
/// preprocessor's output for a target: `target(t)` with its rate (CommandSample::acceleration is
/// ignored). Starts on the target at t = 0, at its rate within the limits. No wind.
/// @throws InvalidInput as CommandPreprocessor, and for less than 1 sample or step.
ReferenceTrajectory shaped_course(const control::CommandLimits& limits, double sample_time,
                                  Eigen::Index samples, Eigen::Index steps,
                                  const std::function<control::CommandSample(double time)>& target);

struct LoopRunOptions {
  std::vector<Influence> without = {};
  bool noise = true;
  std::uint64_t seed = 1;
  plant::Integrator integrator = plant::Integrator::exponential_collocation;
  /// As in SimulationPlan: relative rms error of 1e-5 on the reference antenna.
  double relative_tolerance = 1e-5;
  double absolute_tolerance = 1e-7;
  /// Runs instead of the loop's AntennaController; must outlive the run.
  control::StartedController* controller = nullptr;
  /// As SimulationPlan::progress.
  std::function<bool(Eigen::Index done, Eigen::Index all)> progress = nullptr;
};

enum class RunStatus {
  complete,
  interrupted,  // by progress
  lost,         // the encoder error exceeded lost_error
  failed,       // no steady motion to start from, or the integration failed; see `message`
};
std::string_view to_string(RunStatus status);

/// Encoder error (rad at the sky) beyond which a loop has lost its target: 0.1 deg, above any
/// beamwidth of a large antenna.
inline constexpr double lost_error = 1.75e-3;

struct LoopRun {
  RunStatus status = RunStatus::complete;
  std::string message;             // empty if complete
  plant::SimulationResult result;  // empty if failed
  /// The reference given to the controller (rad of motor): that of the trajectory, shifted to the
  /// antenna's initial position.
  Eigen::VectorXd reference;
  // At the steps of the trajectory, rad at the sky: angle less that reference.
  Eigen::VectorXd boresight_error;
  Eigen::VectorXd encoder_error;
};

/// Runs a trajectory on the nonlinear antenna. It starts in the steady motion in which the motor
/// torque balances the first wind torque at the reference's first rate. The command is 0 in the
/// first sample time: allow some seconds for settling. A failed run is returned as a result with
/// its status.
/// @throws InvalidInput for sizes that differ, an interval that does not divide the sample time,
/// and as the parts.
LoopRun run_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course,
                 const LoopRunOptions& options = {});

/// Runs the same trajectory on the linear plant (no limits, no converter steps), sampled `finer`
/// times as often. The total dead time stays one and a half sample times of the loop as built.
/// `finer` = 1 is the loop as built; large numbers approach the continuous loop. Starts at rest:
/// only the wind and the noise of the trajectory act, which determine the whole error of a linear
/// loop. For one seed the noise is the same only for the same `finer`. @throws InvalidInput as
/// run_loop, and for finer below 1 or a state-space controller sampled finer than it is.
LoopRun run_linear_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course, int finer = 1,
                        const LoopRunOptions& options = {});

}  // namespace boresight::design
