#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace boresight::plant {

/// As many frequencies as are worked on at a time: whole registers, and all sums stay in cache.
inline constexpr std::size_t frequency_block = 64;

/// Complex numbers at the frequencies of a block, real and imaginary parts apart.
struct FrequencyLanes {
  std::array<double, frequency_block> re;
  std::array<double, frequency_block> im;
};

/// One real pole, or one pair with s^2 - 2 Re(p) s + |p|^2, of a system with several responses
/// (entries): entry e has the numerator slope[e] s + level[e].
struct PoleSection {
  std::complex<double> pole;
  std::vector<double> level, slope;
};

/// Loops over the first `n` frequencies w (rad/s) of a block, compiled for wider registers as well;
/// they allocate nothing.
namespace frequency_kernels {

void set(FrequencyLanes& out, double value, std::size_t n);

/// entries[e] = feedthrough[e] + the sum over the sections.
void sum_sections(const std::vector<PoleSection>& sections, const std::vector<double>& feedthrough,
                  const double* w, std::size_t n, FrequencyLanes* entries);

/// sums[p] = sum over modes k of gain[k paths + p]/(w_k^2 - w^2 + 2 j damping_k w_k w).
void sum_modes(const double* mode_frequency, const double* damping_ratio, const double* gain,
               std::size_t modes, std::size_t paths, const double* w, std::size_t n,
               FrequencyLanes* sums);

/// out += j w rate
void add_rate(FrequencyLanes& out, const FrequencyLanes& rate, const double* w, std::size_t n);

/// out += factor other
void accumulate(FrequencyLanes& out, const FrequencyLanes& factor, const FrequencyLanes& other,
                std::size_t n);

/// out = numerator/(1 - loop)
void close_loop(FrequencyLanes& out, const FrequencyLanes& numerator, const FrequencyLanes& loop,
                std::size_t n);

}  // namespace frequency_kernels
}  // namespace boresight::plant
