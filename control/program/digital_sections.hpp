#pragma once

#include <array>
#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control::program {

/// A sampled section, y = (b0 + b1/z + b2/z^2)/(1 + a1/z + a2/z^2) u.
struct DigitalSection {
  std::string name;         // of path and kind, such as "rate_lag"
  std::string description;  // such as "rate lag corner wp"
  int order = 0;            // 0 to 2
  std::array<double, 3> b{};
  std::array<double, 2> a{};
  double static_gain = 1.0;          // H(z = 1), infinite of an integral
  double inverse_static_gain = 1.0;  // 0 of an integral
};

/// A path of the controller as sampled_controller has it: its path_sections from prewarped corners
/// by Tustin's method.
/// @throws InvalidInput as prewarped, and for a section whose static gain is 0 in the rate or
/// position path, which has no steady motion.
std::vector<DigitalSection> digital_sections(const Controller& controller, LoopPath path,
                                             double sample_time);

/// A sampled state space in blocks of one and two states: as it is if no others are coupled, else
/// in real Jordan form without chains, x' = p x + b u of real poles and x' = [re -im; im re] x + B
/// u of pairs, each with output weight 1 of its first state. A state space with (nearly) equal
/// poles that have one eigenvector (plant::highest_modal_condition) is returned as it is.
/// @throws InvalidInput as plant::validate; for several outputs.
plant::StateSpace in_modal_blocks(const plant::StateSpace& controller);

}  // namespace boresight::control::program
