#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/analysis/absolute_stability.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/golden_section.hpp>

namespace boresight::control {
namespace {

// Of 1 + Re (1 + j w q) L = constant - slope q at one frequency.
struct Line {
  double constant = 0.0, slope = 0.0, frequency = 0.0;
};

PopovResult at(const std::vector<Line>& lines, double q) {
  PopovResult result;
  result.slope = q;
  const auto value = [q](const Line& line) { return line.constant - line.slope * q; };
  const Line& least = *std::ranges::min_element(lines, {}, value);
  result.distance = value(least);
  result.frequency = least.frequency;
  result.proven = result.distance > min_popov_distance;
  return result;
}

}  // namespace

PopovResult absolute_stability(const std::function<std::complex<double>(double)>& loop_gain,
                               const Eigen::ArrayXd& frequency) {
  if (frequency.size() == 0) {
    throw InvalidInput("absolute stability: expected at least one frequency, found none");
  }
  std::vector<Line> lines;
  lines.reserve(static_cast<std::size_t>(frequency.size()));
  // No proof needs a q below the first or stands one above the second.
  double needed = 0.0, most = std::numeric_limits<double>::infinity();
  for (const double w : frequency) {
    const std::complex<double> gain = loop_gain(w);
    if (!std::isfinite(gain.real()) || !std::isfinite(gain.imag())) {
      throw NumericalFailure(
          fmt::format("absolute stability: the loop gain at {:.6g} rad/s is not finite", w));
    }
    const Line line{1.0 + gain.real(), w * gain.imag(), w};
    const double zero = line.constant / line.slope;
    if (line.slope > 0.0 && zero > 0.0) most = std::min(most, zero);
    if (line.slope < 0.0 && zero > 0.0) needed = std::max(needed, zero);
    lines.push_back(line);
  }
  // The least of lines is concave in q.
  const double upper = 2.0 * std::max(needed, std::isfinite(most) ? most : 1.0);
  const PopovResult found =
      at(lines, numerics::golden_section_maximum([&](double q) { return at(lines, q).distance; },
                                                 0.0, upper, 1e-12 * upper));
  const PopovResult circle = at(lines, 0.0);
  return circle.distance > found.distance ? circle : found;
}

}  // namespace boresight::control
