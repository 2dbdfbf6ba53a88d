#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace boresight::numerics {

/// A function of independent inputs, each given by its probability (the value of its cumulative
/// distribution, within (0, 1)); writes its outputs. Called from several threads at once.
using QuantileFunction =
    std::function<void(const std::vector<double>& fractions, Eigen::VectorXd& out)>;

struct SobolOptions {
  /// Points per randomisation, a power of two (needed for a balanced set).
  std::size_t points = 512;
  /// Independent scramblings of the same points; their scatter gives the intervals. At least 4;
  /// with 16 the intervals are 9 % wider than with very many.
  std::size_t randomisations = 16;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  double confidence = 0.95;
};

/// An estimate with its interval at the requested confidence: Student's t over the randomisations.
/// The interval is not clipped to 0 and 1: an index near 0 may be slightly negative.
struct EstimatedIndex {
  double value = 0.0, standard_error = 0.0, lower = 0.0, upper = 0.0;
};

struct InputIndices {
  /// Fraction of the variance removed on average if this input becomes known.
  EstimatedIndex first_order;
  /// Fraction of the variance that remains if all other inputs become known: first order and every
  /// interaction of this input.
  EstimatedIndex total;
};

/// Of one output.
struct SobolIndices {
  std::vector<InputIndices> inputs;  // in the order of the inputs; NaN for a constant output
  double mean = 0.0, mean_error = 0.0;
  double variance = 0.0, variance_error = 0.0;
  /// The output is constant (deviation below 1e-12 of its largest magnitude): fractions of its
  /// variance are undefined.
  bool constant = false;
  /// Variance fraction of interactions: 1 less the sum of the first orders.
  double interactions = 0.0;
};

struct SobolResult {
  std::vector<SobolIndices> outputs;
  std::size_t evaluations = 0;  // randomisations x points x (inputs + 2)
};

/// First-order and total Sobol' indices of every output (I. M. Sobol', Math. Comput. Simul. 55,
/// 2001), from the same evaluations. Points are a Sobol' sequence in twice the number of inputs,
/// under Owen's nested uniform scrambling (A. B. Owen, J. Complexity 14(4), 1998). Matrices A, B
/// and A_B^i are taken radially from them (A. Saltelli et al., Comput. Phys. Commun. 181(2), 2010).
/// The total index is that of M. J. W. Jansen (Comput. Phys. Commun. 117, 1999), mean square of
/// f(A) - f(A_B^i) over twice the variance. The first order is also his, with the variance pooled
/// over the pairs f(B), f(A_B^i), which has the least asymptotic variance (A. Janon et al., ESAIM
/// Probab. Stat. 18, 2014). Results do not depend on the number of threads.
/// @throws InvalidInput for no inputs or outputs, more than 500 inputs, points that are no power of
/// two within [16, 2^24], fewer than 4 randomisations, or a confidence outside (0, 1).
/// NumericalFailure for a value that is not finite, naming the probabilities; and exceptions of
/// `function`.
SobolResult sobol_indices(std::size_t inputs, std::size_t outputs, const QuantileFunction& function,
                          const SobolOptions& options = {});

/// `points` rows of a scrambled Sobol' sequence in `dimensions` columns, each within (0, 1): every
/// column has exactly one point in each of `points` equal intervals. For sampling in other designs
/// of experiments.
/// @throws InvalidInput for dimensions outside [1, 1000] or points as above.
Eigen::MatrixXd scrambled_sobol_points(std::size_t points, std::size_t dimensions,
                                       std::uint64_t seed);

}  // namespace boresight::numerics
