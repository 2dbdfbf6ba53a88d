#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A continuous plant with a digital controller. Controller inputs that have the name of a plant
/// output are sampled from it at every sample time, without a filter (include one in the plant).
/// Each controller output has the name of the plant input that it drives. It is held from
/// `computation_delay` after its sample until the next output arrives. Nothing is subtracted: the
/// controller itself forms the error. Its other inputs (references) are external.
struct SampledLoop {
  plant::StateSpace plant;
  plant::StateSpace controller;
  double computation_delay = 0.0;  // s, any multiple or fraction of the sample time
};

/// The closed loop at the sampling instants, exact. Inputs: the plant inputs that the controller
/// does not drive (held from sample to sample), the external controller inputs, and then the
/// noises. Noise `output`_noise is added to the sample of each sampled output, in the controller's
/// order. Outputs: those of the plant, then those of the controller (before the delay). States:
/// those of the plant, the held commands `command`_held_1, ..., then those of the controller.
/// @throws InvalidInput unless the plant is continuous, the controller is sampled, all its outputs
/// are plant inputs and at least one of its inputs is a plant output; for a negative delay; and as
/// plant::connect. NumericalFailure for an algebraic loop without solution.
plant::StateSpace sampled_closed_loop(const SampledLoop& loop);

/// The loop cut at one command, with everything else closed. The input `command` is taken before
/// the hold and delay. The output `command`_returned is minus the controller's response, so the
/// closed-loop poles satisfy 1 + L = 0 and margins are those of negative feedback.
/// @throws as sampled_closed_loop, and InvalidInput for a command that is not an output of the
/// controller.
plant::StateSpace sampled_open_loop(const SampledLoop& loop, std::string_view command);

struct SampledLoopNoise {
  /// White noise into plant inputs that the controller does not drive, by name. Intensity q: E w(t)
  /// w(s) = q delta(t - s) (unit^2 s), the two-sided density per Hz.
  std::map<std::string, double> disturbance_intensity;
  /// Noise of the samples of the controller's measured outputs, by name: variance (unit^2), white
  /// from sample to sample.
  std::map<std::string, double> measurement_variance;
};

/// Root mean squares in steady state, in the order of `outputs`.
struct SampledLoopRms {
  std::vector<std::string> outputs;
  Eigen::VectorXd at_samples;  // at the sampling instants
  Eigen::VectorXd over_time;   // over all time, between the samples as well
};

/// Computes the steady-state rms of plant outputs under the noises, exactly. The covariance at the
/// sampling instants solves the discrete Lyapunov equation of the closed loop. Between them it is
/// integrated together with the held commands over both parts of a period, before and after the
/// delayed command arrives (T. Chen, B. A. Francis, Optimal Sampled-Data Control Systems, 1995, ch.
/// 12; integrals as in plant::propagate_covariance).
/// @throws as sampled_closed_loop; InvalidInput for inconsistent names, a negative intensity or
/// variance, or a disturbance that reaches a sampled or requested output without a lag (its
/// variance would be infinite); NumericalFailure if the closed loop is not stable.
SampledLoopRms sampled_loop_rms(const SampledLoop& loop, const SampledLoopNoise& noise,
                                const std::vector<std::string>& outputs);

}  // namespace boresight::control
