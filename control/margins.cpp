#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boresight/control/margins.hpp>

namespace boresight::control {
namespace {

double bisect(const std::function<double(double)>& value, double low, double high) {
  const bool rises = value(low) < 0.0;
  double a = std::log(low), b = std::log(high);
  while (b - a > 1e-12) {
    const double middle = 0.5 * (a + b);
    ((value(std::exp(middle)) < 0.0) == rises ? a : b) = middle;
  }
  return std::exp(0.5 * (a + b));
}

}  // namespace

Margins margins(const std::function<std::complex<double>(double)>& loop_gain,
                const Eigen::ArrayXd& frequency) {
  Margins result;
  result.increasing_gain_margin = result.delay_margin = std::numeric_limits<double>::infinity();
  const auto log_gain = [&](double w) { return std::log(std::abs(loop_gain(w))); };
  const auto imaginary = [&](double w) { return loop_gain(w).imag(); };
  std::complex<double> previous = loop_gain(frequency[0]);
  for (Eigen::Index i = 1; i < frequency.size(); ++i) {
    const std::complex<double> here = loop_gain(frequency[i]);
    if ((std::abs(previous) < 1.0) != (std::abs(here) < 1.0)) {
      const double w = bisect(log_gain, frequency[i - 1], frequency[i]);
      double margin = std::arg(-loop_gain(w)) * 180.0 / std::numbers::pi;
      if (margin <= -180.0) margin = 180.0;
      result.gain_crossovers.push_back({w, margin});
      result.phase_margin_deg = std::min(result.phase_margin_deg, std::abs(margin));
      const double turn = (margin > 0.0 ? margin : margin + 360.0) * std::numbers::pi / 180.0;
      result.delay_margin = std::min(result.delay_margin, turn / w);
    }
    if ((previous.imag() < 0.0) != (here.imag() < 0.0)) {
      const double w = bisect(imaginary, frequency[i - 1], frequency[i]);
      const std::complex<double> gain = loop_gain(w);
      if (gain.real() < 0.0) {
        const double factor = 1.0 / std::abs(gain);
        result.phase_crossovers.push_back({w, factor});
        if (factor > 1.0) {
          result.increasing_gain_margin = std::min(result.increasing_gain_margin, factor);
        } else {
          result.decreasing_gain_margin = std::max(result.decreasing_gain_margin, factor);
        }
      }
    }
    previous = here;
  }
  return result;
}

}  // namespace boresight::control
