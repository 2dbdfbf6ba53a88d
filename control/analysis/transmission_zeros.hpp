#pragma once

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

struct TransmissionZerosOptions {
  /// Elements up to this fraction of the norm of [A B; C D], in even units (plant::even_units),
  /// count as 0 in rank decisions.
  double tolerance = 1e-12;
};

/// The finite zeros of [A - s I, B; C, D]: where its rank falls below its usual one. Of a minimal
/// system these are the transmission zeros; of another also the uncontrollable and unobservable
/// modes (take plant::minimal_realisation first to have none). The pencil is reduced by orthogonal
/// transformations until D is square and regular (A. Emami-Naeini, P. Van Dooren, Automatica 18(4),
/// 1982), so that zeros at infinity are counted out beforehand and none is invented. Also for more
/// inputs than outputs, and for D = 0. Sorted by magnitude. Sampled systems: zeros in z.
/// A zero of multiplicity k is found to some 1e-15^(1/k) of its size.
/// @throws InvalidInput as validate(system), or for a tolerance that is not between 0 and 1.
Eigen::VectorXcd transmission_zeros(const plant::StateSpace& system,
                                    const TransmissionZerosOptions& options = {});

}  // namespace boresight::control
