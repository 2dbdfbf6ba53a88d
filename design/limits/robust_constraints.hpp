#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include <boresight/design/limits/sampled_setting.hpp>

namespace boresight::design {

/// Constraints that a sampled controller must meet on every plant.
struct SampledLoopGoals {
  double sensitivity_peak = 2.0;  // largest |S| at the valve command, on plants and corners
  double control_effort = 0.6;    // rad/s rms of the noise-driven command
  /// Largest |S| at the valve command on the plants at standstill (Constraints::standstill).
  double standstill_peak = 3.0;
  /// The same on the plants at standstill at an edge between two codes of the encoder. With 3,
  /// motion at rest grew until it reached the next edge.
  double edge_peak = 2.5;
  /// Largest |S| of the position loop, cut at the encoder alone, and at standstill standstill_peak.
  /// Not limited without.
  std::optional<double> position_peak = std::nullopt;
  /// Largest gain from encoder to motor torque (SampledSetting::highest_locked_motor_gain), N
  /// m/rad, on plants whose motor friction locks. Not limited without.
  std::optional<double> locked_motor_gain = std::nullopt;
  /// Least static gain from encoder to command, 1/s (control::static_encoder_gain), of the
  /// controller alone. Not limited without.
  std::optional<double> static_gain = std::nullopt;
};

/// @throws InvalidInput for a peak not above 1, an effort or gain not above 0 and a static gain
/// that is not finite.
void validate(const SampledLoopGoals& goals);

/// The plants of RobustConstraints. Every loop but those of motor_locked must be stable, and
/// within:
struct ConstrainedPlants {
  /// sensitivity_peak, position_peak, control_effort.
  std::span<const SampledSetting> plants;
  /// standstill_peak; with a position_peak, of the position loop too.
  std::span<const SampledSetting> at_standstill = {};
  std::span<const SampledSetting> at_edges = {};  // edge_peak
  std::span<const SampledSetting> corners = {};   // sensitivity_peak
  /// locked_motor_gain. The motor does not move: stability is that of the plants at standstill.
  std::span<const SampledSetting> motor_locked = {};
};

/// The goals over plants: every loop is stable and within them, and the controller is stable by
/// itself. A limit on the position loop's peak holds on the plants and at standstill.
/// Refers to the plants; all have the same frequencies. Results do not depend on the number of
/// threads.
class RobustConstraints {
 public:
  /// @throws InvalidInput as validate, without plants and for plants of different frequencies.
  RobustConstraints(const ConstrainedPlants& plants, const SampledLoopGoals& goals,
                    unsigned threads);

  std::span<const SampledSetting> plants() const { return on_.plants; }
  std::span<const SampledSetting> at_standstill() const { return on_.at_standstill; }
  std::span<const SampledSetting> at_edges() const { return on_.at_edges; }
  std::span<const SampledSetting> corners() const { return on_.corners; }
  std::span<const SampledSetting> motor_locked() const { return on_.motor_locked; }
  const SampledLoopGoals& goals() const { return goals_; }
  unsigned threads() const { return threads_; }

  /// Whether every loop and the controller by itself are stable.
  bool stable(const plant::StateSpace& controller) const;

  /// ln of the largest ratio of a quantity to its goal: met up to 0. At most 3, which also stands
  /// for an unstable loop or controller. Where a peak exceeds its goal only peaks count.
  double excess(const plant::StateSpace& controller) const;
  /// The same with the controller's peaks() at hand.
  double excess(const plant::StateSpace& controller, const Eigen::VectorXd& peaks) const;

  /// ln of the ratio of each peak to its goal: of |S| at the valve command on the plants, those at
  /// standstill, those at edges and the corners, then of the position loop's, if limited, on the
  /// plants and those at standstill, then of the gain on a locked motor, if limited, then of the
  /// least static gain to the controller's, if limited. Without regard to stability.
  Eigen::VectorXd peaks(const plant::StateSpace& controller) const;

  /// Boresight rms (rad of motor) on the plants, then on those at standstill, with a controller
  /// that is stable on all.
  Eigen::VectorXd rms(const plant::StateSpace& controller) const;
  /// The largest over the plants, not those at standstill.
  double largest_rms(const plant::StateSpace& controller) const;

 private:
  ConstrainedPlants on_;
  SampledLoopGoals goals_;
  unsigned threads_;
};

}  // namespace boresight::design
