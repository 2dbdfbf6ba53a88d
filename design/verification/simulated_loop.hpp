#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::design {

/// A tuned loop as it is built: the nonlinear antenna under a sampled controller
/// (control::AntennaController) that computes for one sample time. All at the motor shaft.
struct SimulatedLoop {
  plant::NonlinearAntenna antenna;
  /// What the law was designed on: its viscous friction stands in for the friction curve where that
  /// is switched off, and feedforward follows from it.
  plant::AntennaPlant linear;
  control::ControlLaw law;
  double gear_ratio = 1.0;
  double sample_time = 0.02;           // s
  control::SensorNoise noise;          // of densities: as the linear design has it
  double encoder_resolution = 0.0;     // rad of motor, step of the converter; 0: none
  double tachometer_resolution = 0.0;  // rad/s
  bool feedforward = true;             // control::plant_feedforward
  bool anti_windup = true;
};

/// The loop of a law tuned on a problem, which gives it its noise and, being one and a half sample
/// times (computation and half a hold), its delay the sample time. Without converter steps.
SimulatedLoop make_simulated_loop(const TrackingProblem& problem,
                                  const plant::NonlinearAntenna& antenna,
                                  const control::ControlLaw& law);

/// What the linear design leaves out, each to be switched off alone:
///   friction       the curve and its bristles; the linear plant's viscous friction instead
///   limits         stroke, spool speed and command limit
///   quantisation   steps of encoder and tachometer
///   orifice        flow straight in the port's opening, whatever the pressures; no make-up valves
///   gear           backlash: both halves always in contact
enum class Influence { friction, limits, quantisation, orifice, gear };
inline constexpr Influence influences[] = {Influence::friction, Influence::limits,
                                           Influence::quantisation, Influence::orifice,
                                           Influence::gear};
std::string_view to_string(Influence influence);

/// Whether the loop has it at all: something to switch off.
bool has(const SimulatedLoop& loop, Influence influence);

/// What the loop is told and what acts on it, from t = 0 in steps of `interval`, of which the
/// sample time is a multiple.
struct LoopCourse {
  double interval = 0.0;                   // s
  Eigen::VectorXd reference;               // rad of motor
  Eigen::VectorXd reference_rate;          // rad/s
  Eigen::VectorXd reference_acceleration;  // rad/s2, from this step on
  Eigen::VectorXd wind_torque;             // N m at the motor
};

/// A course of `samples` sample times, each in `steps` steps, whose reference is what the command
/// preprocessor makes of a target: `target(t)` with its rate (CommandSample::acceleration is not
/// read). Starts on the target at t = 0, at its rate within the limits. No wind.
/// @throws InvalidInput as CommandPreprocessor, and for less than 1 sample or step.
LoopCourse shaped_course(const control::CommandLimits& limits, double sample_time,
                         Eigen::Index samples, Eigen::Index steps,
                         const std::function<control::CommandSample(double time)>& target);

struct LoopRunOptions {
  std::vector<Influence> without = {};
  bool noise = true;
  std::uint64_t seed = 1;
  plant::Integrator integrator = plant::Integrator::exponential_collocation;
  /// As in SimulationPlan: an rms to 1e-5 of itself on the reference antenna.
  double relative_tolerance = 1e-5;
  double absolute_tolerance = 1e-7;
  /// As SimulationPlan::progress.
  std::function<bool(Eigen::Index done, Eigen::Index all)> progress = nullptr;
};

enum class RunStatus {
  complete,
  interrupted,  // by progress
  lost,         // the encoder went farther from the reference than lost_error
  failed,       // no steady motion to start from, or the integration gave up; see `message`
};
std::string_view to_string(RunStatus status);

/// Encoder error (rad at the sky) beyond which a loop has lost its target: 0.1 deg, more than any
/// beam of a large antenna is wide.
inline constexpr double lost_error = 1.75e-3;

struct LoopRun {
  RunStatus status = RunStatus::complete;
  std::string message;             // empty if complete
  plant::SimulationResult result;  // empty if failed
  /// What the controller was given (rad of motor): the course's, shifted to where the antenna
  /// begins.
  Eigen::VectorXd reference;
  // At the steps of the course, rad at the sky: less that reference.
  Eigen::VectorXd beam_error;
  Eigen::VectorXd encoder_error;
};

/// Runs a course on the nonlinear antenna, from the steady motion that holds the reference's first
/// rate against the first wind torque (the command under way in the first sample time is 0: give a
/// run some seconds to settle). A run without a usable end is a stated result.
/// @throws InvalidInput for sizes that differ, an interval that does not divide the sample time,
/// and as the parts.
LoopRun run_loop(const SimulatedLoop& loop, const LoopCourse& course,
                 const LoopRunOptions& options = {});

/// The same course on the linear plant (no limits, no steps), sampled `finer` times as often with
/// the same total dead time of one and a half sample times: 1 is the loop as built, large numbers
/// the continuous one. Starts at rest: only the wind and the noise of the course act, which is all
/// that a linear loop's error owes to them. Of the same seed, noise is the same for the same
/// `finer` only. @throws InvalidInput as run_loop, and for finer below 1.
LoopRun run_linear_loop(const SimulatedLoop& loop, const LoopCourse& course, int finer = 1,
                        const LoopRunOptions& options = {});

}  // namespace boresight::design
