#pragma once

#include "peer_family.hpp"
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::reference {

/// peer_open_loop() as modes around a core: L(s) from the valve's command d to loop_gain, which is
/// -u of the closed loop without d.
inline plant::ModalSystem peer_modal_open_loop(Eigen::Index modes, const PeerGains& gains = {}) {
  plant::ModalSystem system = peer_modal_system(modes, gains);
  plant::StateSpace& core = system.core;
  const Eigen::Index d = plant::input_index(core, "d"), u = plant::output_index(core, "u");
  const Eigen::VectorXd valve = core.b.col(d);
  core.d(u, d) = 0.0;
  core.a -= valve * core.c.row(u);
  core.b -= valve * core.d.row(u);
  core.c.row(u) *= -1.0;
  core.d.row(u) *= -1.0;
  core.outputs[static_cast<std::size_t>(u)] = "loop_gain";
  system.inputs = {"d"};
  system.outputs = {"loop_gain"};
  for (const char* unused : {"t", "n"}) {
    const Eigen::Index column = plant::input_index(core, unused);
    const Eigen::Index last = core.b.cols() - 1 - column;
    core.b.middleCols(column, last) = core.b.rightCols(last).eval();
    core.d.middleCols(column, last) = core.d.rightCols(last).eval();
    core.b.conservativeResize(Eigen::NoChange, core.b.cols() - 1);
    core.d.conservativeResize(Eigen::NoChange, core.d.cols() - 1);
    core.inputs.erase(core.inputs.begin() + column);
  }
  return system;
}

}  // namespace boresight::reference
