#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// The discrete Fourier transform of N real samples (any N above 0, in no unit):
///   X[k] = sum over n of x[n] exp(-2 pi i k n/N),   k = 0 .. N/2 rounded down,
/// the rest being X[N - k] = conj X[k]; X[0] and X[N/2] of an even N are real. Errors are some
/// 1e-16 of the norm of x. O(N log N) where N has small prime factors only, and as many times
/// slower as its largest prime factor is large.
/// @throws InvalidInput for no samples, samples that are not finite, above 2^28 samples, and where
/// N times its largest prime factor is above 2^32 (seconds): pad to fast_transform_length.
Eigen::VectorXcd fourier_transform(const Eigen::Ref<const Eigen::VectorXd>& series);

/// The N real samples whose transform is X, half = X[0 .. N/2]:
///   x[n] = 1/N (X[0] + sum over k > 0 of X[k] exp(2 pi i k n/N) and its conjugate),
/// X[N/2] of an even N once. The imaginary parts of X[0] and of that must be 0.
/// @throws InvalidInput for a length of `half` that is not N/2 + 1 or elements that are not finite,
/// and as fourier_transform.
Eigen::VectorXd inverse_fourier_transform(const Eigen::Ref<const Eigen::VectorXcd>& half,
                                          Eigen::Index samples);

/// The smallest N >= `samples` (1 .. 2^28) that is even (or 1) and has the prime factors 2, 3 and 5
/// only. @throws InvalidInput out of this range.
Eigen::Index fast_transform_length(Eigen::Index samples);

}  // namespace boresight::numerics
