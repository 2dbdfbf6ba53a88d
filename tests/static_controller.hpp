#pragma once

#include <boresight/control/controllers/loop_structure.hpp>

namespace boresight::reference {

/// A state space of order 0 on tachometer and encoder.
inline control::LoopStructure static_controller() {
  plant::StateSpace system;
  system.a.resize(0, 0);
  system.b.resize(0, 2);
  system.c.resize(1, 0);
  system.d = (Eigen::MatrixXd(1, 2) << -0.5, -0.2).finished();
  system.sample_time = 0.02;
  system.inputs = {"tachometer", "encoder"};
  system.outputs = {"valve_demand"};
  return control::LoopStructure::of_state_space("state space, order 0", system);
}

}  // namespace boresight::reference
