#pragma once

#include <string>
#include <utility>
#include <vector>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

/// Elements between -1 and 1 throughout; names as of `state_space`.
inline plant::StateSpace random_system(RandomNumbers& random, Eigen::Index n, Eigen::Index inputs,
                                       Eigen::Index outputs) {
  return state_space(random.matrix(n, n), random.matrix(n, inputs), random.matrix(outputs, n),
                     random.matrix(outputs, inputs));
}

/// The same with a feedthrough below 0.3, so that loops of two are well posed; states `name`1, ...
inline plant::StateSpace random_system(RandomNumbers& random, Eigen::Index n,
                                       std::vector<std::string> inputs,
                                       std::vector<std::string> outputs, const std::string& name) {
  plant::StateSpace system = random_system(random, n, static_cast<Eigen::Index>(inputs.size()),
                                           static_cast<Eigen::Index>(outputs.size()));
  system.d *= 0.3;
  system.inputs = std::move(inputs);
  system.outputs = std::move(outputs);
  for (std::size_t i = 0; i < system.states.size(); ++i) {
    system.states[i] = name + std::to_string(i + 1);
  }
  return system;
}

}  // namespace boresight::reference
