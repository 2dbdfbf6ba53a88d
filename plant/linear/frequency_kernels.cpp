#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/linear/frequency_kernels.hpp>

namespace boresight::plant::frequency_kernels {
namespace {

[[gnu::always_inline]] inline void fill(FrequencyLanes& out, double value, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    out.re[i] = value;
    out.im[i] = 0.0;
  }
}

// 1/(w0^2 - w^2 + 2 j damping w), the difference of squares as a product so that it is exact near
// the resonance; `damping` is the distance of the pole from the axis, `rest` its square where w0 is
// the pole's imaginary part.
[[gnu::always_inline]] inline void resonance(FrequencyLanes& out, const double* w, double w0,
                                             double damping, double rest, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double re = (w0 - w[i]) * (w0 + w[i]) + rest;
    const double im = 2.0 * damping * w[i];
    const double scale = 1.0 / (re * re + im * im);
    out.re[i] = re * scale;
    out.im[i] = -im * scale;
  }
}

}  // namespace

BORESIGHT_VECTOR_CLONES void set(FrequencyLanes& out, double value, std::size_t n) {
  fill(out, value, n);
}

BORESIGHT_VECTOR_CLONES void sum_sections(const std::vector<PoleSection>& sections,
                                          const std::vector<double>& feedthrough, const double* w,
                                          std::size_t n, FrequencyLanes* entries) {
  const std::size_t count = feedthrough.size();
  for (std::size_t e = 0; e < count; ++e) fill(entries[e], feedthrough[e], n);
  FrequencyLanes inverse, slope;  // NOLINT(*-member-init): written before they are read
  for (const auto& section : sections) {
    const bool pair = section.pole.imag() > 0.0;
    const double decay = -section.pole.real();
    if (pair) {
      resonance(inverse, w, section.pole.imag(), decay, decay * decay, n);
      for (std::size_t i = 0; i < n; ++i) {
        slope.re[i] = -w[i] * inverse.im[i];
        slope.im[i] = w[i] * inverse.re[i];
      }
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        const double scale = 1.0 / (decay * decay + w[i] * w[i]);
        inverse.re[i] = decay * scale;
        inverse.im[i] = -w[i] * scale;
      }
    }
    for (std::size_t e = 0; e < count; ++e) {
      const double level = section.level[e];
      const double rise = section.slope[e];
      if (level == 0.0 && rise == 0.0) continue;
      double* re = entries[e].re.data();
      double* im = entries[e].im.data();
      if (pair) {
        for (std::size_t i = 0; i < n; ++i) {
          re[i] += level * inverse.re[i] + rise * slope.re[i];
          im[i] += level * inverse.im[i] + rise * slope.im[i];
        }
      } else {
        for (std::size_t i = 0; i < n; ++i) {
          re[i] += level * inverse.re[i];
          im[i] += level * inverse.im[i];
        }
      }
    }
  }
}

// Sums over the modes, four at a time so that a sum is loaded and stored less often.
BORESIGHT_VECTOR_CLONES void sum_modes(const double* frequency, const double* damping,
                                       const double* gain, std::size_t modes, std::size_t paths,
                                       const double* w, std::size_t n, FrequencyLanes* sums) {
  for (std::size_t p = 0; p < paths; ++p) fill(sums[p], 0.0, n);
  std::array<FrequencyLanes, 4> term;  // NOLINT(*-member-init): written before it is read
  std::size_t k = 0;
  for (; k + 4 <= modes; k += 4) {
    for (std::size_t q = 0; q < 4; ++q) {
      resonance(term[q], w, frequency[k + q], damping[k + q] * frequency[k + q], 0.0, n);
    }
    for (std::size_t p = 0; p < paths; ++p) {
      const double g0 = gain[k * paths + p], g1 = gain[(k + 1) * paths + p];
      const double g2 = gain[(k + 2) * paths + p], g3 = gain[(k + 3) * paths + p];
      double* re = sums[p].re.data();
      double* im = sums[p].im.data();
      for (std::size_t i = 0; i < n; ++i) {
        re[i] +=
            (g0 * term[0].re[i] + g1 * term[1].re[i]) + (g2 * term[2].re[i] + g3 * term[3].re[i]);
        im[i] +=
            (g0 * term[0].im[i] + g1 * term[1].im[i]) + (g2 * term[2].im[i] + g3 * term[3].im[i]);
      }
    }
  }
  for (; k < modes; ++k) {
    resonance(term[0], w, frequency[k], damping[k] * frequency[k], 0.0, n);
    for (std::size_t p = 0; p < paths; ++p) {
      const double g = gain[k * paths + p];
      for (std::size_t i = 0; i < n; ++i) {
        sums[p].re[i] += g * term[0].re[i];
        sums[p].im[i] += g * term[0].im[i];
      }
    }
  }
}

BORESIGHT_VECTOR_CLONES void add_rate(FrequencyLanes& out, const FrequencyLanes& rate,
                                      const double* w, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    out.re[i] -= w[i] * rate.im[i];
    out.im[i] += w[i] * rate.re[i];
  }
}

BORESIGHT_VECTOR_CLONES void accumulate(FrequencyLanes& out, const FrequencyLanes& factor,
                                        const FrequencyLanes& other, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    out.re[i] += factor.re[i] * other.re[i] - factor.im[i] * other.im[i];
    out.im[i] += factor.re[i] * other.im[i] + factor.im[i] * other.re[i];
  }
}

BORESIGHT_VECTOR_CLONES void close_loop(FrequencyLanes& out, const FrequencyLanes& numerator,
                                        const FrequencyLanes& loop, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double dr = 1.0 - loop.re[i], di = -loop.im[i];
    const double scale = 1.0 / (dr * dr + di * di);
    const double nr = numerator.re[i], ni = numerator.im[i];
    out.re[i] = (nr * dr + ni * di) * scale;
    out.im[i] = (ni * dr - nr * di) * scale;
  }
}

}  // namespace boresight::plant::frequency_kernels
