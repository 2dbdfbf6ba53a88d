#pragma once

#include <string>

#include "random_numbers.hpp"
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

struct RandomSystemOptions {
  int max_modes = 4;  // pairs or real poles
  Eigen::Index inputs = 1;
  Eigen::Index outputs = 1;
  double min_damping = 1e-3;
  double max_damping = 1.0;
  /// Each mode's input is scaled by 1e-10 with this probability.
  double nearly_uncontrollable = 0.1;
  bool feedthrough = true;
};

/// A stable system of lightly damped pairs and real poles over three decades, its states mixed by a
/// transformation of moderate condition.
inline plant::StateSpace random_stable_system(RandomNumbers& random,
                                              const RandomSystemOptions& options = {}) {
  const int modes = random.integer(1, options.max_modes);
  std::vector<Eigen::Index> sizes;
  Eigen::Index n = 0;
  for (int i = 0; i < modes; ++i) {
    sizes.push_back(random.uniform(0.0, 1.0) < 0.7 ? 2 : 1);
    n += sizes.back();
  }
  plant::StateSpace system;
  system.a = Eigen::MatrixXd::Zero(n, n);
  system.b = random.matrix(n, options.inputs);
  system.c = random.matrix(options.outputs, n);
  system.d = random.matrix(options.outputs, options.inputs);
  if (!options.feedthrough || random.uniform(0.0, 1.0) < 0.5) system.d.setZero();
  Eigen::Index at = 0;
  for (const Eigen::Index size : sizes) {
    const double w = random.log_uniform(0.1, 100.0);
    const double zeta = random.log_uniform(options.min_damping, options.max_damping);
    if (size == 2) {
      const double turning = w * std::sqrt(std::max(0.0, 1.0 - zeta * zeta));
      system.a.block<2, 2>(at, at) << -zeta * w, turning, -turning, -zeta * w;
    } else {
      system.a(at, at) = -w;
    }
    if (random.uniform(0.0, 1.0) < options.nearly_uncontrollable) {
      system.b.middleRows(at, size) *= 1e-10;
    }
    at += size;
  }
  const Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(n, n) + 0.4 * random.matrix(n, n);
  system.a = numerics::linear_solve(mix, system.a * mix, "random system");
  system.b = numerics::linear_solve(mix, system.b, "random system");
  system.c = system.c * mix;
  for (Eigen::Index i = 0; i < n; ++i) system.states.push_back("x" + std::to_string(i));
  for (Eigen::Index i = 0; i < options.inputs; ++i) {
    system.inputs.push_back("u" + std::to_string(i));
  }
  for (Eigen::Index i = 0; i < options.outputs; ++i) {
    system.outputs.push_back("y" + std::to_string(i));
  }
  return system;
}

}  // namespace boresight::reference
