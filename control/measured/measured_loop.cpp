#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/measured/measured_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

constexpr double degrees = 180.0 / std::numbers::pi;

struct Point {
  double x = 0.0;  // ln w
  Complex gain;
};

void check(const MeasuredLoop& loop, const MeasuredLoopOptions& options) {
  const Eigen::Index count = loop.frequency.size();
  if (loop.gain.size() != count || (loop.coherence.size() != 0 && loop.coherence.size() != count)) {
    throw InvalidInput(fmt::format(
        "margins of a measured loop: expected as many gains (and coherences, if any) as {} "
        "frequencies, found {} and {}",
        count, loop.gain.size(), loop.coherence.size()));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const double w = loop.frequency[i];
    if (!(w > (i == 0 ? 0.0 : loop.frequency[i - 1])) || !std::isfinite(w)) {
      throw InvalidInput(fmt::format(
          "margins of a measured loop: expected positive frequencies that rise, found {} rad/s at "
          "position {}",
          w, i));
    }
    if (!std::isfinite(loop.gain[i].real()) || !std::isfinite(loop.gain[i].imag())) {
      throw InvalidInput(
          fmt::format("margins of a measured loop: the gain at {} rad/s is not finite", w));
    }
    const double coherence = loop.coherence.size() == 0 ? 1.0 : loop.coherence[i];
    const bool in_range = coherence >= 0.0 && coherence <= 1.0;
    if (!in_range) {
      throw InvalidInput(fmt::format(
          "margins of a measured loop: expected a coherence from 0 to 1, found {} at {} rad/s",
          coherence, w));
    }
  }
  const bool options_hold = options.lowest_coherence >= 0.0 && options.lowest_coherence <= 1.0 &&
                            options.largest_turn_deg > 0.0 && options.largest_turn_deg < 180.0 &&
                            options.largest_factor > 1.0 && options.widest_step > 1.0;
  if (!options_hold) {
    throw InvalidInput(fmt::format(
        "margins of a measured loop: expected a lowest coherence from 0 to 1, a largest turn "
        "between 0 and 180 degrees, a largest factor and a widest step above 1, found {}, {}, {} "
        "and {}",
        options.lowest_coherence, options.largest_turn_deg, options.largest_factor,
        options.widest_step));
  }
}

std::vector<Point> usable_points(const MeasuredLoop& loop, double lowest_coherence) {
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < loop.frequency.size(); ++i) {
    if (loop.coherence.size() != 0 && loop.coherence[i] < lowest_coherence) continue;
    if (loop.gain[i] == 0.0) continue;
    points.push_back({std::log(loop.frequency[i]), loop.gain[i]});
  }
  if (points.size() < 2) {
    throw InvalidInput(fmt::format(
        "margins of a measured loop: expected at least two usable points, found {} of {} (a "
        "coherence below {:g} or a gain of 0 makes a point unusable)",
        points.size(), loop.frequency.size(), lowest_coherence));
  }
  return points;
}

// Median of the steps in ln w around the one after `i`, without that one itself.
double median_step(const std::vector<Point>& points, std::size_t i) {
  constexpr std::size_t reach = 5;
  std::vector<double> steps;
  const std::size_t first = i > reach ? i - reach : 0;
  for (std::size_t k = first; k <= i + reach && k + 1 < points.size(); ++k) {
    if (k != i) steps.push_back(points[k + 1].x - points[k].x);
  }
  if (steps.empty()) return points[i + 1].x - points[i].x;
  return numerics::median(std::move(steps));
}

// Whether the line from one gain to the other meets the negative real axis.
bool meets_negative_axis(Complex from, Complex to) {
  if ((from.imag() < 0.0) == (to.imag() < 0.0)) return false;
  const double part = from.imag() / (from.imag() - to.imag());
  return from.real() + part * (to.real() - from.real()) < 0.0;
}

// The curve through consecutive points that resolve L.
class Curve {
 public:
  explicit Curve(const std::vector<Point>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      x_.push_back(points[i].x);
      // As the logarithm of L, its angle followed from point to point.
      value_.emplace_back(
          std::log(std::abs(points[i].gain)),
          i == 0 ? std::arg(points[0].gain)
                 : value_.back().imag() + std::arg(points[i].gain / points[i - 1].gain));
    }
    const std::size_t count = x_.size();
    const auto secant = [&](std::size_t i) {
      return (value_[i + 1] - value_[i]) / (x_[i + 1] - x_[i]);
    };
    for (std::size_t i = 0; i < count; ++i) {
      if (count == 2) {
        slope_.push_back(secant(0));
        continue;
      }
      // Derivative at x[i] of the parabola through three points, i one of them.
      const std::size_t k = std::clamp<std::size_t>(i, 1, count - 2);
      const Complex bend = (secant(k) - secant(k - 1)) / (x_[k + 1] - x_[k - 1]);
      slope_.push_back(secant(k - 1) + bend * (2.0 * x_[i] - x_[k - 1] - x_[k]));
    }
  }

  Complex gain(double w) const {
    const double x = std::clamp(std::log(w), x_.front(), x_.back());
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - x_.begin()) - 1;
    const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h;
    const double s = t * t * (3.0 - 2.0 * t);
    return std::exp(value_[i] * (1.0 - s) + value_[i + 1] * s +
                    h * t * (1.0 - t) * (slope_[i] * (1.0 - t) - slope_[i + 1] * t));
  }

 private:
  std::vector<double> x_;
  std::vector<Complex> value_, slope_;
};

Margins margins_of(const std::vector<Point>& points, const CrossoverOptions& options) {
  const Curve curve(points);
  // The cubics can have an extremum between points.
  constexpr Eigen::Index parts = 4;
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::ArrayXd frequency((count - 1) * parts + 1);
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const auto k = static_cast<std::size_t>(std::min(i / parts, count - 2));
    const double part =
        static_cast<double>(i - static_cast<Eigen::Index>(k) * parts) / static_cast<double>(parts);
    frequency[i] = std::exp(points[k].x * (1.0 - part) + points[k + 1].x * part);
  }
  return margins([&](double w) { return curve.gain(w); }, frequency, options);
}

template <typename Items>
void append(Items& items, const Items& more) {
  items.insert(items.end(), more.begin(), more.end());
}

void include(Margins& all, const Margins& more) {
  append(all.gain_crossovers, more.gain_crossovers);
  append(all.phase_crossovers, more.phase_crossovers);
  append(all.tangencies, more.tangencies);
  if (more.sensitivity.magnitude > all.sensitivity.magnitude) all.sensitivity = more.sensitivity;
  if (more.complementary.magnitude > all.complementary.magnitude) {
    all.complementary = more.complementary;
  }
  if (more.disk.alpha < all.disk.alpha) all.disk = more.disk;
}

}  // namespace

MeasuredMargins margins(const MeasuredLoop& loop, const MeasuredLoopOptions& options) {
  check(loop, options);
  const std::vector<Point> points = usable_points(loop, options.lowest_coherence);
  MeasuredMargins result;
  result.points_used = points.size();
  result.points_left_out = static_cast<std::size_t>(loop.frequency.size()) - points.size();
  result.gain_at_lowest = std::abs(points.front().gain);
  result.gain_at_highest = std::abs(points.back().gain);

  std::vector<std::vector<Point>> stretches(1);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    stretches.back().push_back(points[i]);
    const Complex ratio = points[i + 1].gain / points[i].gain;
    const double turn = std::arg(ratio) * degrees, factor = std::abs(ratio);
    const bool gap = points[i + 1].x - points[i].x > options.widest_step * median_step(points, i);
    if (!gap && std::abs(turn) <= options.largest_turn_deg && factor <= options.largest_factor &&
        factor >= 1.0 / options.largest_factor) {
      continue;
    }
    const Complex from = points[i].gain, to = points[i + 1].gain;
    result.unresolved.push_back({std::exp(points[i].x), std::exp(points[i + 1].x), turn, factor,
                                 gap, (std::abs(from) < 1.0) != (std::abs(to) < 1.0),
                                 meets_negative_axis(from, to)});
    stretches.emplace_back();
  }
  stretches.back().push_back(points.back());

  bool first = true;
  for (const auto& stretch : stretches) {
    const Margins part =
        stretch.size() > 1
            ? margins_of(stretch, options.crossovers)
            : margins([&](double) { return stretch[0].gain; },
                      Eigen::ArrayXd::Constant(1, std::exp(stretch[0].x)), options.crossovers);
    if (first) {
      result.margins = part;
    } else {
      include(result.margins, part);
    }
    first = false;
  }
  update_smallest(result.margins);
  result.margins.lowest_frequency = std::exp(points.front().x);
  result.margins.highest_frequency = std::exp(points.back().x);
  return result;
}

}  // namespace boresight::control
