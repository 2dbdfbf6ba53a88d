#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::reference {

struct Band {
  double low = 0.0;  // Hz
  double high = 0.0;
};

/// Third-octave bands with the middles first, first 2^(1/3), .. up to last.
inline std::vector<Band> third_octaves(double first, double last) {
  std::vector<Band> bands;
  for (double middle = first; middle < last * 1.001; middle *= std::cbrt(2.0)) {
    bands.push_back({middle * std::pow(2.0, -1.0 / 6.0), middle * std::pow(2.0, 1.0 / 6.0)});
  }
  return bands;
}

/// Integral of a spectrum over a band, by Simpson's rule in the logarithm of the frequency.
template <typename Spectrum>
double integral(const Spectrum& spectrum, const Band& band, int intervals = 200) {
  const double step = std::log(band.high / band.low) / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double f = band.low * std::exp(i * step);
    const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * f * spectrum(f);
  }
  return sum * step / 3.0;
}

/// Powers of the lines k/T of a series, k = 1, 2, ..; with Hann's window where its ends do not
/// meet.
inline Eigen::ArrayXd line_powers(const Eigen::VectorXd& series, bool window) {
  const auto samples = static_cast<double>(series.size());
  Eigen::VectorXd tapered = series;
  if (window) {
    const double turn = 2.0 * std::numbers::pi / samples;
    for (Eigen::Index i = 0; i < series.size(); ++i) {
      // Of mean square 1.
      tapered[i] *= std::sqrt(2.0 / 3.0) * (1.0 - std::cos(turn * (static_cast<double>(i) + 0.5)));
    }
  }
  Eigen::ArrayXd powers =
      numerics::fourier_transform(tapered).tail(series.size() / 2).array().abs2() * 2.0 /
      (samples * samples);
  if (series.size() % 2 == 0) powers[powers.size() - 1] *= 0.5;
  return powers;
}

/// Fraction of each line's cell, a step wide about it, that lies in a band.
inline Eigen::ArrayXd fractions(Eigen::Index lines, double step, const Band& band) {
  return Eigen::ArrayXd::NullaryExpr(lines, [&](Eigen::Index i) {
    const double middle = static_cast<double>(i + 1) * step;
    const double low = std::max(band.low, middle - 0.5 * step);
    const double high = std::min(band.high, middle + 0.5 * step);
    return std::max(high - low, 0.0) / step;
  });
}

}  // namespace boresight::reference
