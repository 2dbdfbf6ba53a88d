#pragma once

#include <string>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::reference {

/// Loops without integrals that are stable on the reference antenna.
inline control::Controller lag_loops() {
  return {control::LoopStructure::named("LL+L"), {0.3, 3.0, 40.0, 4.0, 1.5, 15.0}};
}

/// The same as a sampled state space of order 2 on tachometer and encoder, stable by itself.
inline control::Controller lag_loops_as_state_space(const std::string& name = "states") {
  return control::state_space_controller(
      name, plant::subsystem(control::sampled_controller(lag_loops(), 0.02),
                             {"tachometer", "encoder"}, {"valve_demand"}));
}

}  // namespace boresight::reference
