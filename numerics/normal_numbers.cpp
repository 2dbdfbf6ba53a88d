#include <cmath>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::numerics {
namespace {

// The middles of 2^53 equal parts of 0..1.
double uniform(std::uint64_t word) {
  return (static_cast<double>(word >> 11U) + 0.5) * 0x1p-53;
}

}  // namespace

std::uint64_t splitmix64(std::uint64_t state, std::uint64_t index) {
  std::uint64_t word = state + (index + 1U) * 0x9e3779b97f4a7c15U;
  word = (word ^ (word >> 30U)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27U)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31U);
}

// Scrambled twice, so that neighbouring seeds and streams start at unrelated places.
NormalNumbers::NormalNumbers(std::uint64_t seed, std::uint64_t stream)
    : state_(splitmix64(splitmix64(seed, 0), stream)) {}

std::complex<double> NormalNumbers::pair(std::uint64_t index) const {
  const double radius = std::sqrt(-2.0 * std::log(uniform(splitmix64(state_, 2U * index))));
  const double phase = two_pi * uniform(splitmix64(state_, 2U * index + 1U));
  return {radius * std::cos(phase), radius * std::sin(phase)};
}

}  // namespace boresight::numerics
