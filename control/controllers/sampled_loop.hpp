#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A continuous plant under a digital controller: every sample time of the controller its inputs
/// that have the name of a plant's output are sampled from it (no filter: put one into the plant);
/// its outputs, each called as the input of the plant that it drives, are held from
/// `computation_delay` after their sample until the next ones arrive. Nothing is subtracted: an
/// error is formed within the controller. Its other inputs (references) come from outside.
struct SampledLoop {
  plant::StateSpace plant;
  plant::StateSpace controller;
  double computation_delay = 0.0;  // s, any multiple or fraction of the sample time
};

/// The closed loop at the sampling instants, exact. Inputs: those of the plant that the controller
/// does not drive (held from sample to sample), those of the controller that come from outside,
/// then `output`_noise for each output that the controller takes, in the controller's order, added
/// to the sample. Outputs: those of the plant, then those of the controller (before the delay).
/// States: those of the plant, the held commands `command`_held_1, ..., then the controller's.
/// @throws InvalidInput unless the plant is continuous, the controller sampled, its outputs all
/// inputs of the plant and at least one of its inputs an output of the plant, for a negative delay,
/// and as plant::connect; NumericalFailure for an algebraic loop without solution.
plant::StateSpace sampled_closed_loop(const SampledLoop& loop);

/// The loop cut at one command, everything else closed: from `command` as it enters the hold and
/// delay to `command`_returned, which is minus what the controller answers, so that the closed loop
/// has the poles where 1 + L = 0 and margins are those of negative feedback.
/// @throws as sampled_closed_loop, and InvalidInput for a command that the controller has not.
plant::StateSpace sampled_open_loop(const SampledLoop& loop, std::string_view command);

struct SampledLoopNoise {
  /// White noise into inputs of the plant that the controller does not drive, by name: intensity q,
  /// E w(t) w(s) = q delta(t - s) (unit^2 s), the two-sided density per Hz.
  std::map<std::string, double> disturbance_intensity;
  /// Noise of the samples of outputs that the controller takes, by name: variance (unit^2), white
  /// from sample to sample.
  std::map<std::string, double> measurement_variance;
};

/// Root mean squares in steady state, in the order of `outputs`.
struct SampledLoopRms {
  std::vector<std::string> outputs;
  Eigen::VectorXd at_samples;  // at the sampling instants
  Eigen::VectorXd over_time;   // over all time, between the samples as well
};

/// What the noises do to outputs of the plant, exactly: the covariance at the sampling instants by
/// the discrete Lyapunov equation of the closed loop, that between them by integrating it together
/// with the held commands over both parts of a period, before and after the delayed command arrives
/// (T. Chen, B. A. Francis, Optimal Sampled-Data Control Systems, 1995, ch. 12; integrals as in
/// plant::propagate_covariance).
/// @throws as sampled_closed_loop, InvalidInput for names that do not fit, a negative intensity or
/// variance, or a disturbance that reaches a sampled or asked output without a lag (its variance
/// would be infinite); NumericalFailure if the closed loop is not stable.
SampledLoopRms sampled_loop_rms(const SampledLoop& loop, const SampledLoopNoise& noise,
                                const std::vector<std::string>& outputs);

}  // namespace boresight::control
