#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

struct MinimalRealisationOptions {
  /// Couplings up to this fraction of the norm of A count as none, in units in which states,
  /// inputs and outputs are balanced (even_units): rounding leaves some 1e-15 times the number of
  /// states, a pole and a zero that differ by a fraction d of their own size some d times that
  /// size over the norm.
  double tolerance = 1e-12;
  /// The states that remain are called `states`_1, `states`_2, ...
  std::string states = "minimal";
};

struct MinimalRealisation {
  StateSpace system;
  Eigen::VectorXcd uncontrollable;  // eigenvalues removed because no input reaches them
  Eigen::VectorXcd unobservable;    // of the rest, those removed because no output sees them
  /// Couplings relative to the norm of A: the largest that counted as none (0 if there was none)
  /// and the smallest that was kept. The nearer they are to each other, the less sure the order.
  double largest_neglected = 0.0;
  double smallest_kept = 1.0;
};

/// Removes uncontrollable and unobservable states by orthogonal staircase transformations (P. Van
/// Dooren, IEEE Trans. Automatic Control 26(1), 1981) of the system in balanced units. The transfer
/// matrix is unchanged. If nothing is to be removed, the system is returned unchanged, with its
/// states and their names.
/// @throws InvalidInput as validate(system), or for a tolerance that is not between 0 and 1.
MinimalRealisation minimal_realisation(const StateSpace& system,
                                       const MinimalRealisationOptions& options = {});

}  // namespace boresight::plant
