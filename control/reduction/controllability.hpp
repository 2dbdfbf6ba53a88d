#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

struct AccessOptions {
  /// An eigenvalue whose distance is not above this counts as out of reach.
  double tolerance = 1e-12;
  /// How many states are named with an eigenvalue at most.
  int most_states = 4;
};

/// An eigenvalue of A, of a pair that with positive imaginary part, and how well it is reached from
/// the inputs (seen from the outputs).
struct ModeAccess {
  std::complex<double> eigenvalue;
  /// Smallest singular value of [A - s I, B] over |A| (Frobenius), in balanced states and with
  /// every column of B scaled to |A|: how far, relative to A, the nearest system is in which the
  /// mode is out of reach, whatever the units of states and inputs. In the states as given where
  /// only balancing puts the mode out of reach.
  double distance = 0.0;
  /// Whether it is stable by more than rounding.
  bool stable = false;
  /// The states that make up most of the combination that is nearest to being out of reach, the
  /// largest first; those with less than a tenth of the largest's share of its square are left out.
  std::vector<std::string> states;
  /// For each input |w^H b|/|b|, w the unit vector of that combination: 0 for one that does not act
  /// on it at all.
  Eigen::VectorXd by_port;
};

/// How the eigenvalues are reached by the inputs, or seen by the outputs.
struct Access {
  std::vector<ModeAccess> modes;      // every distinct eigenvalue, by rising distance
  std::vector<ModeAccess> unreached;  // those of them that are out of reach
  /// One sentence on these: "the inputs u, v do not reach the eigenvalue 2 (states a, b)".
  std::string description;

  bool complete() const { return unreached.empty(); }
  /// Stabilisable, detectable: what is out of reach is stable.
  bool leaves_only_stable() const;
};

/// Controllability by the test of Popov, Belevitch and Hautus: the rank of [A - s I, B] at every
/// eigenvalue s, and at the means of those that lie close together (where A has chains the mean is
/// far more exact than its members); from the Schur form of balanced A with an O(n^2 inputs)
/// triangularisation and inverse iteration at each; O(n^3) in all, no powers of A.
/// @throws InvalidInput as validate(system); NumericalFailure as numerics::real_schur.
Access controllability(const plant::StateSpace& system, const AccessOptions& options = {});

/// Observability: the same for the transposed system, [A - s I; C].
Access observability(const plant::StateSpace& system, const AccessOptions& options = {});

}  // namespace boresight::control
