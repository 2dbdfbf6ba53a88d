#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/singular_value_bound.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/modal/modal_enclosure.hpp>

namespace boresight::control {
namespace {

using numerics::FrequencyInterval;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

void check(const PeakGainOptions& options) {
  if (!(options.relative_tolerance >= 1e-14) || options.relative_tolerance == infinity) {
    throw InvalidInput(
        fmt::format("peak_gain: expected a relative tolerance of 1e-14 or more, found {}",
                    options.relative_tolerance));
  }
  if (options.max_intervals < 2) {
    throw InvalidInput(
        fmt::format("peak_gain: expected at least 2 intervals, found {}", options.max_intervals));
  }
}

struct Candidate {
  FrequencyInterval interval;
  double upper;
  std::size_t number;

  // The most promising first; of equals the older.
  bool operator<(const Candidate& other) const {
    return upper != other.upper ? upper < other.upper : number > other.number;
  }
};

// Halves the interval that may hold the most until nothing exceeds the best gain found.
template <typename Enclose>
PeakGain search(Enclose enclose, double highest_pole, const PeakGainOptions& options) {
  PeakGain result;
  double highest = 0.0;
  std::priority_queue<Candidate> waiting;
  const auto visit = [&](const FrequencyInterval& interval) {
    const GainBound bound = enclose(interval);
    ++result.intervals;
    if (std::isfinite(bound.upper) && bound.at_centre > highest) {
      highest = bound.at_centre;
      // At the point itself nothing but rounding is left of the enclosure.
      const GainBound point = enclose({interval.centre, 0.0, interval.reciprocal});
      const double sure = 2.0 * point.at_centre - point.upper;
      if (sure > result.lower) {
        result.lower = sure;
        result.frequency = interval.frequency();
      }
    }
    return bound;
  };
  const auto add = [&](const FrequencyInterval& interval) {
    const double before = result.lower;
    GainBound bound = visit(interval);
    waiting.push({interval, std::isnan(bound.upper) ? infinity : bound.upper, result.intervals});
    // A new best is climbed at once, so that fewer intervals are in question.
    FrequencyInterval point = interval;
    for (int step = 0; step < 3 && result.lower > before * (1.0 + options.relative_tolerance) &&
                       std::isfinite(bound.upper);
         ++step) {
      const double centre =
          std::clamp(point.centre + bound.best_offset, interval.centre - interval.half_width,
                     interval.centre + interval.half_width);
      if (centre == point.centre) break;
      // The parabola is asked around the new point as far as the interval's own ends.
      point.centre = centre;
      point.half_width = std::min(interval.centre + interval.half_width - centre,
                                  centre - interval.centre + interval.half_width);
      bound = visit(point);
    }
  };
  const double middle = highest_pole > 0.0 ? 2.0 * highest_pole : 1.0;
  add({0.5 * middle, 0.5 * middle, false});
  add({0.5 / middle, 0.5 / middle, true});
  // The ends of the axis themselves.
  visit({0.0, 0.0, false});
  visit({0.0, 0.0, true});
  while (true) {
    const Candidate top = waiting.top();
    result.upper = std::max(top.upper, result.lower);
    result.closed = result.upper <= result.lower * (1.0 + options.relative_tolerance);
    const FrequencyInterval& whole = top.interval;
    const bool narrow = whole.half_width <= 4.0 * epsilon * (whole.centre + whole.half_width);
    if (result.closed || narrow || result.intervals + 2 > options.max_intervals) break;
    waiting.pop();
    const double half = 0.5 * whole.half_width;
    add({whole.centre - half, half, whole.reciprocal});
    add({whole.centre + half, half, whole.reciprocal});
  }
  return result;
}

double highest_pole(const plant::StateSpaceEnclosure& core, const plant::StateSpace& system) {
  if (core.form() == nullptr) return system.a.norm();
  const auto& poles = core.form()->poles;
  return poles.size() > 0 ? poles.cwiseAbs().maxCoeff() : 0.0;
}

// Whether a pole that moves the outputs lies on the axis to working precision.
bool has_pole_on_axis(const plant::ModalForm& form) {
  const Eigen::Index count = form.poles.size();
  if (count == 0) return false;
  Eigen::VectorXd residue(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    residue[k] = form.output.col(k).norm() * form.input.row(k).norm();
  }
  const double negligible = 1e-13 * residue.maxCoeff();
  for (Eigen::Index k = 0; k < count; ++k) {
    if (std::abs(form.poles[k].real()) <= form.pole_error[k] && residue[k] > negligible)
      return true;
  }
  return false;
}

// z = (1 + s)/(1 - s): the same values, the unit circle on the imaginary axis.
plant::StateSpace bilinear(const plant::StateSpace& sampled) {
  const Eigen::Index n = sampled.a.rows();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd right(n, n + sampled.b.cols());
  right << sampled.a - identity, sampled.b;
  const Eigen::MatrixXd solved = numerics::linear_solve(
      sampled.a + identity, right, "peak_gain: a sampled system with a pole at -1");
  plant::StateSpace result = sampled;
  result.a = solved.leftCols(n);
  result.b = std::numbers::sqrt2 * solved.rightCols(sampled.b.cols());
  // C (A + I)^-1 = (C - C (A + I)^-1 (A - I))/2
  result.c = std::sqrt(0.5) * (sampled.c - sampled.c * result.a);
  result.d = sampled.d - sampled.c * solved.rightCols(sampled.b.cols());
  result.sample_time = 0.0;
  return result;
}

}  // namespace

PeakGain peak_gain(const plant::ModalSystem& system, std::string_view input,
                   std::string_view output, const PeakGainOptions& options) {
  check(options);
  plant::ModalEnclosure enclosure(system, input, output);
  return search(
      [&](const FrequencyInterval& interval) {
        return gain_bound(enclosure.enclose(interval), interval.half_width);
      },
      enclosure.highest_pole(), options);
}

PeakGain peak_gain(const plant::StateSpace& system, const PeakGainOptions& options) {
  check(options);
  plant::validate(system);
  const plant::StateSpace continuous = system.sample_time > 0.0 ? bilinear(system) : system;
  const plant::StateSpaceEnclosure enclosure(continuous);
  if (enclosure.form() != nullptr && has_pole_on_axis(*enclosure.form())) {
    PeakGain result;
    result.lower = result.upper = infinity;
    result.closed = true;
    return result;
  }
  std::vector<numerics::TaylorModel> elements;
  const bool scalar = enclosure.rows() == 1 && enclosure.columns() == 1;
  PeakGain result = search(
      [&](const FrequencyInterval& interval) {
        enclosure.enclose(interval, elements);
        return scalar ? gain_bound(elements.front(), interval.half_width)
                      : gain_bound(elements, enclosure.rows(), interval.half_width);
      },
      highest_pole(enclosure, continuous), options);
  if (system.sample_time > 0.0) {
    result.frequency = 2.0 * std::atan(result.frequency) / system.sample_time;
  }
  return result;
}

}  // namespace boresight::control
