#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace boresight::numerics {

/// A function of independent inputs, each given by its share (the value of its cumulative
/// distribution, within (0, 1)): writes its outputs. Called from several threads at once.
using ShareFunction = std::function<void(const std::vector<double>& shares, Eigen::VectorXd& out)>;

struct SobolOptions {
  /// Points of one randomisation, a power of two (else the points would not be balanced).
  std::size_t points = 512;
  /// Independent scramblings of the same points: intervals are taken from how they scatter. At
  /// least 4; with 16 the intervals are 9 % wider than they would be with very many.
  std::size_t randomisations = 16;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  double confidence = 0.95;
};

/// An estimate with its interval at the confidence asked for: Student's t over the randomisations.
/// The interval is not cut off at 0 and 1: an index near 0 may come out a little negative.
struct EstimatedIndex {
  double value = 0.0, standard_error = 0.0, lower = 0.0, upper = 0.0;
};

struct InputIndices {
  /// Share of the variance that goes if this input becomes known (on average over its values).
  EstimatedIndex first_order;
  /// Share of the variance that stays if all other inputs become known: first order and every
  /// interaction this input has part in.
  EstimatedIndex total;
};

/// Of one output.
struct SobolIndices {
  std::vector<InputIndices> inputs;  // in the order of the shares; NaN for a constant output
  double mean = 0.0, mean_error = 0.0;
  double variance = 0.0, variance_error = 0.0;
  /// The output does not vary (deviation below 1e-12 of its largest magnitude): no share of its
  /// variance means anything.
  bool constant = false;
  /// What no single input explains: 1 less the sum of the first orders.
  double interactions = 0.0;
};

struct SobolResult {
  std::vector<SobolIndices> outputs;
  std::size_t evaluations = 0;  // randomisations x points x (inputs + 2)
};

/// First-order and total Sobol' indices of every output (I. M. Sobol', Math. Comput. Simul. 55,
/// 2001), from the same evaluations. Points are a Sobol' sequence in twice the inputs' number of
/// dimensions, under Owen's nested uniform scrambling (A. B. Owen, J. Complexity 14(4), 1998);
/// matrices A, B and A_B^i radially from them (A. Saltelli et al., Comput. Phys. Commun. 181(2),
/// 2010). The total index is M. J. W. Jansen's (Comput. Phys. Commun. 117, 1999), mean square of
/// f(A) - f(A_B^i) over twice the variance; the first order his too with the variance pooled over
/// the very pairs f(B), f(A_B^i), which has the least asymptotic variance of all (A. Janon et al.,
/// ESAIM Probab. Stat. 18, 2014). The same numbers for every thread count.
/// @throws InvalidInput for no inputs or outputs, more than 500 inputs, points that are no power of
/// two within [16, 2^24], fewer than 4 randomisations, or a confidence outside (0, 1);
/// NumericalFailure for a value that is not finite, naming the shares; and what `function` throws.
SobolResult sobol_indices(std::size_t inputs, std::size_t outputs, const ShareFunction& function,
                          const SobolOptions& options = {});

/// `points` rows of a scrambled Sobol' sequence in `dimensions` columns, each within (0, 1): every
/// column has exactly one point in each of `points` equal intervals. For draws of designs of
/// experiments other than the above. @throws InvalidInput for dimensions outside [1, 1000] or
/// points as above.
Eigen::MatrixXd scrambled_sobol_points(std::size_t points, std::size_t dimensions,
                                       std::uint64_t seed);

}  // namespace boresight::numerics
