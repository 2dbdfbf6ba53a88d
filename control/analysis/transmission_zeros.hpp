#pragma once

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

struct TransmissionZerosOptions {
  /// Elements up to this fraction of the norm of [A B; C D], in even units (plant::even_units),
  /// count as 0 in rank decisions.
  double tolerance = 1e-12;
};

/// The finite zeros of [A - s I, B; C, D], where its rank falls below the normal rank. For a
/// minimal system these are the transmission zeros. Otherwise they include the uncontrollable and
/// unobservable modes (apply plant::minimal_realisation first to exclude these). Orthogonal
/// transformations reduce the pencil until D is square and regular (A. Emami-Naeini, P. Van Dooren,
/// Automatica 18(4), 1982). Zeros at infinity are thereby removed first, and no spurious zeros
/// appear. More inputs than outputs and D = 0 are permitted. Sorted by magnitude. Sampled systems:
/// zeros in z. A zero of multiplicity k is accurate to about 1e-15^(1/k) of its magnitude.
/// @throws InvalidInput as validate(system), or for a tolerance that is not between 0 and 1.
Eigen::VectorXcd transmission_zeros(const plant::StateSpace& system,
                                    const TransmissionZerosOptions& options = {});

}  // namespace boresight::control
