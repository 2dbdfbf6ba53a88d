#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/loop_point.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// Derivatives of both returns by ln of the gains of a path, less the factor d ln X/d ln g.
struct ReturnDerivative {
  Complex rate, both;
};

ReturnDerivative return_derivative(const LoopPoint& point, const plant::ResponsePoint& response,
                                   LoopPath path) {
  const auto& c = point.compensator;
  const Complex position = point.dead_time * c.rate * c.position * point.angle;
  switch (path) {
    case LoopPath::rate: {
      const Complex rate = point.dead_time * c.rate * response.tachometer_command;
      return {rate, rate + position};
    }
    case LoopPath::pressure: {
      const Complex pressure = point.dead_time * c.pressure * response.torque_command;
      return {pressure, pressure};
    }
    case LoopPath::position:
      return {0.0, position};
    case LoopPath::compliance:
      return {0.0, -point.dead_time * c.rate * c.position * c.compliance * response.torque_command};
  }
  throw InvalidInput("loop evaluator: not a path");
}

double sensitivity(const LoopPoint& point, LoopBreak loop_break) {
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return 1.0 / std::sqrt(std::norm(point.rate_return));
    case LoopBreak::valve_command:
      return 1.0 / std::sqrt(std::norm(point.both_return));
    case LoopBreak::position_loop:
      return std::sqrt(std::norm(point.rate_return) / std::norm(point.both_return));
  }
  throw InvalidInput("loop evaluator: not a loop break");
}

// A point of ln|S|^2 over ln w.
struct LogPoint {
  double place = 0.0, value = 0.0;
};

// Vertex of the parabola through three points of ln|S|^2 over ln w, the middle one the highest, and
// how far it rises above that.
struct Vertex {
  double place = 0.0;
  double rise = 0.0;
};

Vertex vertex(const LogPoint& left, const LogPoint& middle, const LogPoint& right) {
  const double to_left = left.place - middle.place, to_right = right.place - middle.place;
  const double down_left = left.value - middle.value, down_right = right.value - middle.value;
  const double curvature = (down_right / to_right - down_left / to_left) / (to_right - to_left);
  const double slope = down_left / to_left - curvature * to_left;
  if (!(curvature < 0.0)) return {middle.place, 0.0};
  // A step to the very end of the bracket would not shorten it.
  const double shift = std::clamp(-0.5 * slope / curvature, 0.9 * to_left, 0.9 * to_right);
  return {middle.place + shift, (slope + curvature * shift) * shift};
}

// Climbs by successive parabolas through the best point and its neighbours to where they promise no
// more than `enough`, or `value(place)` is as good as known.
template <typename Value>
LogPoint climb(LogPoint left, LogPoint middle, LogPoint right, Value value) {
  constexpr int max_steps = 8;
  constexpr double enough = 1e-11;  // of ln|S|^2
  for (int step = 0; step < max_steps; ++step) {
    const Vertex top = vertex(left, middle, right);
    if (top.place == middle.place || (top.rise < enough && step > 0)) break;
    const LogPoint found{top.place, value(top.place)};
    // The highest of the four with its neighbours.
    const bool beyond = found.place > middle.place;
    if (found.value > middle.value) {
      (beyond ? left : right) = middle;
      middle = found;
    } else {
      (beyond ? right : left) = found;
    }
    if (top.rise < enough) break;
  }
  return middle;
}

}  // namespace

std::size_t LoopEvaluator::State::points() const {
  return panels_.empty() ? static_cast<std::size_t>(response().frequency.size())
                         : leaves_.size() * numerics::pack_size;
}

double LoopEvaluator::State::sensitivity_square(std::size_t loop_break, std::size_t i) const {
  return values_[leaves_[i / numerics::pack_size]]
      .sensitivity_square[loop_break][i % numerics::pack_size];
}

LoopEvaluator::State::PointOnAxis LoopEvaluator::State::point_on_axis(LoopBreak loop_break,
                                                                      std::size_t i) const {
  const GridPack& pack = packs_[leaves_[i / numerics::pack_size]];
  return {std::log(pack.frequency[i % numerics::pack_size]),
          std::log(sensitivity_square(static_cast<std::size_t>(loop_break), i))};
}

// ln|S|^2 from the polynomials through the returns in the panel around `place`.
LoopEvaluator::State::Interpolation LoopEvaluator::State::interpolate(LoopBreak loop_break,
                                                                      std::size_t near,
                                                                      double place) const {
  std::size_t leaf = near / numerics::pack_size;
  const auto offset = [&] {
    const FrequencyPanel& panel = panels_[leaves_[leaf]];
    return (place - panel.centre()) / panel.half_width();
  };
  if (offset() > 1.0 && leaf + 1 < leaves_.size()) {
    ++leaf;
  } else if (offset() < -1.0 && leaf > 0) {
    --leaf;
  }
  const double u = offset();
  const PanelRule& rule = panel_rule();
  const LoopValues& values = values_[leaves_[leaf]];
  Complex rate = 0.0, both = 0.0;
  double total = 0.0, product = 1.0;
  for (std::size_t j = 0; j < numerics::pack_size; ++j) {
    const double away = u - rule.node[j];
    const Complex rate_here{values.rate_return.re[j], values.rate_return.im[j]};
    const Complex both_here{values.both_return.re[j], values.both_return.im[j]};
    if (away == 0.0) {
      rate = rate_here;
      both = both_here;
      total = 1.0;
      product = 0.0;
      break;
    }
    product *= away;
    const double weight = rule.barycentric[j] / away;
    rate += weight * rate_here;
    both += weight * both_here;
    total += weight;
  }
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return {std::log(total * total / std::norm(rate)), product, leaf};
    case LoopBreak::valve_command:
      return {std::log(total * total / std::norm(both)), product, leaf};
    case LoopBreak::position_loop:
      return {std::log(std::norm(rate) / std::norm(both)), product, leaf};
  }
  throw InvalidInput("loop evaluator: not a loop break");
}

SensitivityPeak LoopEvaluator::State::peak_at(const Controller& controller, LoopBreak loop_break,
                                              double frequency) const {
  const plant::ResponsePoint response = channels_.at(frequency);
  const LoopPoint point = loop_point(response, controller, frequency, delay_);
  SensitivityPeak peak;
  peak.frequency = frequency;
  peak.magnitude = sensitivity(point, loop_break);
  const Complex rate_inverse = 1.0 / point.rate_return, both_inverse = 1.0 / point.both_return;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    const ReturnDerivative change = return_derivative(point, response, block.path);
    const Complex of_rate = change.rate * rate_inverse;
    const Complex of_both = change.both * both_inverse;
    const Complex of_break = loop_break == LoopBreak::rate_loop_alone ? -of_rate
                             : loop_break == LoopBreak::valve_command ? -of_both
                                                                      : of_rate - of_both;
    for (std::size_t j = 0; j < block.gains.size(); ++j, ++k) {
      peak.log_gradient[k] = (of_break * point.compensator.by_gain[k]).real();
    }
  }
  return peak;
}

// Between the points of panels the returns are polynomials, and the plant is asked at the top only.
// What it says there corrects the polynomial: its error is nearly the product of the distances from
// the points times a constant.
SensitivityPeak LoopEvaluator::State::polish(const Controller& controller, LoopBreak loop_break,
                                             std::size_t i) const {
  const auto on_grid = [&](std::size_t k) {
    const PointOnAxis point = point_on_axis(loop_break, k);
    return LogPoint{point.place, point.value};
  };
  const LogPoint left = on_grid(i - 1), middle = on_grid(i), right = on_grid(i + 1);
  if (!panels_.empty()) {
    constexpr double agreement = 3e-7;  // of ln|S|^2
    constexpr int max_corrections = 3;
    double factor = 0.0;
    std::size_t corrected_leaf = leaves_.size();
    const auto value = [&](double place) {
      const Interpolation found = interpolate(loop_break, i, place);
      return found.value + (found.leaf == corrected_leaf ? factor * found.product : 0.0);
    };
    for (int round = 0; round < max_corrections; ++round) {
      const LogPoint top = climb(left, middle, right, value);
      const SensitivityPeak peak = peak_at(controller, loop_break, std::exp(top.place));
      const double error = 2.0 * std::log(peak.magnitude) - top.value;
      if (std::abs(error) < agreement) {
        // That the polynomial is right here does not make this the top: it may end here, or slope
        // the wrong way.
        constexpr double enough = 4e-9;  // of ln|S|^2
        const auto exact = [&](double place) {
          const double w = std::exp(place);
          return LogPoint{
              place, 2.0 * std::log(sensitivity(loop_point(channels_.at(w), controller, w, delay_),
                                                loop_break))};
        };
        const double aside = 0.1 * std::min(middle.place - left.place, right.place - middle.place);
        const LogPoint here{top.place, 2.0 * std::log(peak.magnitude)};
        const LogPoint before = exact(top.place - aside), after = exact(top.place + aside);
        if (here.value < before.value || here.value < after.value) break;
        if (vertex(before, here, after).rise < enough) return peak;
        // A parabola through points so close together has its top where the curve has.
        const LogPoint found =
            climb(before, here, after, [&](double place) { return exact(place).value; });
        return peak_at(controller, loop_break, std::exp(found.place));
      }
      const Interpolation there = interpolate(loop_break, i, top.place);
      if (there.product == 0.0) break;
      factor = (there.leaf == corrected_leaf ? factor : 0.0) + error / there.product;
      corrected_leaf = there.leaf;
    }
  }
  const LogPoint top = climb(left, middle, right, [&](double place) {
    return 2.0 * std::log(peak_at(controller, loop_break, std::exp(place)).magnitude);
  });
  return peak_at(controller, loop_break, std::exp(top.place));
}

void LoopEvaluator::State::find_peaks(const Controller& controller, LoopBreak loop_break,
                                      PeakList& peaks) const {
  // The highest few, in falling order.
  struct Maximum {
    std::size_t place = 0;
    double square = 0.0;
  };
  std::array<Maximum, PeakList::maximum> maxima{};
  std::size_t count = 0;
  const auto consider = [&](const Maximum& found) {
    std::size_t place = count;
    while (place > 0 && maxima[place - 1].square < found.square) --place;
    if (place >= PeakList::maximum) return;
    count = std::min(count + 1, PeakList::maximum);
    for (std::size_t j = count - 1; j > place; --j) maxima[j] = maxima[j - 1];
    maxima[place] = found;
  };
  const auto b = static_cast<std::size_t>(loop_break);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Beyond a state space's Nyquist frequency there are images of what is below.
  const double nyquist = nyquist_frequency(controller);
  const auto frequency = [&](std::size_t i) {
    return packs_[leaves_[i / numerics::pack_size]].frequency[i % numerics::pack_size];
  };
  std::size_t last = points();
  while (last > 0 && !(frequency(last - 1) < nyquist)) --last;
  double before = infinity, here = infinity;
  for (std::size_t i = 0; i < last; i += numerics::pack_size) {
    const numerics::RealPack& square =
        values_[leaves_[i / numerics::pack_size]].sensitivity_square[b];
    const std::size_t lanes = std::min(numerics::pack_size, last - i);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double after = square[lane];
      if (here > 1.0 && here >= before && here > after && here < infinity) {
        consider({i + lane - 1, here});
      }
      before = here;
      here = after;
    }
  }
  // |S| is even about the Nyquist frequency: where it rises up to there, that is a peak.
  const bool rises_to_end = last < points() && here > 1.0 && here >= before && here < infinity;
  if (rises_to_end) consider({last - 1, here});
  for (std::size_t m = 0; m < count; ++m) {
    const std::size_t i = maxima[m].place;
    peaks.push_back(rises_to_end && i + 1 == last ? peak_at(controller, loop_break, frequency(i))
                                                  : polish(controller, loop_break, i));
  }
  std::sort(peaks.begin(), peaks.end(), [](const SensitivityPeak& x, const SensitivityPeak& y) {
    return x.magnitude > y.magnitude;
  });
}

}  // namespace boresight::control
