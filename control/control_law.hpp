#pragma once

#include <array>
#include <complex>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/state_space.hpp>

namespace boresight::control {

/// Loop structures:
///   rate      u = kr (1 + wi/s) / (1 + s/wp) (r - tachometer)
///   position  r = -kp (1 + wip/s) encoder
/// `pi` is without the lag (wp absent).
enum class LoopStructure { pi, pi_with_lag };
std::string_view to_string(LoopStructure structure);

enum class Gain { rate_gain, rate_integral, rate_lag, position_gain, position_integral };

/// What a gain is called, its SI unit, and the bounds a search keeps to.
struct GainDescription {
  Gain gain;
  std::string_view name;
  std::string_view symbol;
  std::string_view unit;
  double lower;
  double upper;
};

/// The gains of a structure in the order of its gain vector.
const std::vector<GainDescription>& gain_descriptions(LoopStructure structure);

/// One control law: a structure with its gains, each positive, in the order of gain_descriptions:
/// rate gain (1), rate integral corner (rad/s), [rate lag corner (rad/s)], position gain (1/s),
/// position integral corner (rad/s).
struct ControlLaw {
  LoopStructure structure = LoopStructure::pi;
  std::vector<double> gains;
};

/// @throws InvalidInput for the wrong number of gains or one that is not positive and finite.
void validate(const ControlLaw& law);

/// The gain of that kind. @throws InvalidInput if the structure has none.
double gain(const ControlLaw& law, Gain kind);

inline constexpr std::size_t most_gains = 5;

/// Compensators at s = j w, and the logarithmic derivatives of each by each gain (d ln R/d ln g):
/// zero where the gain is not in that compensator.
struct CompensatorResponse {
  std::complex<double> rate;      // R(s), rad/s of valve command per rad/s of rate error
  std::complex<double> position;  // P(s), rad/s of rate command per rad of encoder
  std::array<std::complex<double>, most_gains> rate_by_gain{};
  std::array<std::complex<double>, most_gains> position_by_gain{};
};
CompensatorResponse compensator_response(const ControlLaw& law, double angular_frequency);

/// The law as a state space: inputs tachometer (rad/s), encoder (rad), rate_disturbance (rad/s,
/// added to the rate command); outputs valve_demand (rad/s, before the dead time), rate_command.
plant::StateSpace to_state_space(const ControlLaw& law);

}  // namespace boresight::control
