#pragma once

#include <complex>
#include <cstdint>

namespace boresight::numerics {

/// Number `index` (from 0) of the sequence of splitmix64 from `state`: uniform over all 64-bit
/// words (G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014; the published sequence starts at index 0).
std::uint64_t splitmix64(std::uint64_t state, std::uint64_t index);

/// Counter-based standard normal numbers: number pair `index` of a seed's stream does not depend on
/// earlier calls or the standard library (unlike std::normal_distribution). Streams of one seed are
/// independent, and so are seeds. Box-Muller transform of two numbers of splitmix64, so that none
/// lies beyond 8.7.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed, std::uint64_t stream = 0);

  /// Two independent numbers of mean 0 and variance 1 as real and imaginary part.
  std::complex<double> pair(std::uint64_t index) const;

 private:
  std::uint64_t state_;
};

}  // namespace boresight::numerics
