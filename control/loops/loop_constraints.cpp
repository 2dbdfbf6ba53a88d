#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <boresight/control/loops/loop_constraints.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// Changes of L by ln of the compensator of each path, over L.
using ByPath = std::array<Complex, 4>;

struct BrokenLoop {
  Complex value;
  ByPath by_path;
};

BrokenLoop broken_loop(const plant::ResponsePoint& response, double frequency,
                       const CompensatorResponse& c, double delay, LoopBreak loop_break) {
  const Complex dead_time = std::polar(1.0, -frequency * delay);
  const Complex rate = dead_time * c.rate * response.tachometer_command;
  const Complex pressure = dead_time * c.pressure * response.torque_command;
  const Complex through = dead_time * c.rate * c.position;
  const Complex bending = through * c.compliance * response.torque_command;
  const Complex position = through * response.encoder_command - bending;
  switch (loop_break) {
    case LoopBreak::rate_loop_alone: {
      const Complex loop = rate + pressure;
      return {loop, {rate / loop, pressure / loop, 0.0, 0.0}};
    }
    case LoopBreak::valve_command: {
      const Complex loop = rate + pressure + position;
      return {loop, {(rate + position) / loop, pressure / loop, position / loop, -bending / loop}};
    }
    case LoopBreak::position_loop: {
      const Complex inner = 1.0 + rate + pressure;
      return {position / inner, {1.0 - rate / inner, -pressure / inner, 1.0, -bending / position}};
    }
  }
  throw InvalidInput("loop goals: not a loop break");
}

// L at one break of one controller over frequency, on the grid and between.
class LoopCurve {
 public:
  LoopCurve(const LoopChannels& channels, double delay, const Controller& controller,
            LoopBreak loop_break)
      : channels_(channels), delay_(delay), controller_(controller), break_(loop_break) {
    validate(controller);
  }

  const Eigen::ArrayXd& frequency() const { return channels_.response.frequency; }
  Complex on_grid(Eigen::Index i) const {
    const double w = frequency()[i];
    return broken_loop(plant::point(channels_.response, i), w, compensator_response(controller_, w),
                       delay_, break_)
        .value;
  }
  Complex at(double w) const {
    return broken_loop(channels_.at(w), w, compensator_response(controller_, w), delay_, break_)
        .value;
  }
  LoopGainPoint with_gradient(double w) const {
    return loop_gain_with_gradient(channels_.at(w), w, controller_, delay_, break_);
  }
  // How many frequencies of the grid do not exceed nyquist_frequency.
  Eigen::Index size_below_nyquist() const {
    return std::ranges::upper_bound(frequency(), nyquist_frequency(controller_)) -
           frequency().begin();
  }
  // d ln L / d ln w by central difference.
  Complex slope(double w) const {
    constexpr double step = 1e-6;
    return std::log(at(w * (1.0 + step)) / at(w * (1.0 - step))) / (2.0 * step);
  }

 private:
  const LoopChannels& channels_;
  double delay_;
  const Controller& controller_;
  LoopBreak break_;
};

// Where `side` changes sign between two frequencies.
double crossing(const std::function<double(double)>& side, double low, double at_low, double high,
                double at_high) {
  return std::exp(numerics::bracketed_root([&](double x) { return side(std::exp(x)); },
                                           std::log(low), std::log(high), at_low, at_high));
}

std::vector<LoopQuantity> smallest(std::vector<LoopQuantity> quantities, std::size_t maximum) {
  std::ranges::stable_sort(quantities, {}, &LoopQuantity::value);
  if (quantities.size() > maximum) quantities.resize(maximum);
  return quantities;
}

}  // namespace

LoopGainPoint loop_gain_with_gradient(const plant::ResponsePoint& response, double frequency,
                                      const Controller& controller, double delay,
                                      LoopBreak loop_break) {
  const CompensatorResponse c = compensator_response(controller, frequency);
  const BrokenLoop loop = broken_loop(response, frequency, c, delay, loop_break);
  LoopGainPoint point{loop.value, {}};
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    for (std::size_t j = 0; j < block.gains.size(); ++j, ++k) {
      point.by_gain[k] = loop.by_path.at(static_cast<std::size_t>(block.path)) * c.by_gain[k];
    }
  }
  return point;
}

std::vector<LoopQuantity> smallest_gain_margins(const LoopChannels& channels, double delay,
                                                const Controller& controller, LoopBreak loop_break,
                                                std::size_t maximum) {
  const LoopCurve loop(channels, delay, controller, loop_break);
  const Eigen::ArrayXd& w = loop.frequency();
  const Eigen::Index size = loop.size_below_nyquist();
  std::vector<LoopQuantity> found;
  Complex before = loop.on_grid(0);
  for (Eigen::Index i = 1; i < size; ++i) {
    const Complex here = loop.on_grid(i);
    const bool crosses =
        (before.imag() < 0.0) != (here.imag() < 0.0) && (before.real() < 0.0 || here.real() < 0.0);
    if (crosses) {
      const double at = crossing([&](double x) { return loop.at(x).imag(); }, w[i - 1],
                                 before.imag(), w[i], here.imag());
      const LoopGainPoint point = loop.with_gradient(at);
      const Complex slope = loop.slope(at);
      const double magnitude = std::abs(point.value);
      if (point.value.real() < 0.0) {
        const double sign = magnitude < 1.0 ? -1.0 : 1.0;
        LoopQuantity margin{at, magnitude < 1.0 ? 1.0 / magnitude : magnitude, {}};
        for (std::size_t k = 0; k < controller.gains.size(); ++k) {
          const Complex by = point.by_gain[k];
          margin.log_gradient[k] = sign * (by.real() - slope.real() * by.imag() / slope.imag());
        }
        found.push_back(margin);
      }
    }
    before = here;
  }
  return smallest(std::move(found), maximum);
}

std::vector<LoopQuantity> smallest_phase_margins(const LoopChannels& channels, double delay,
                                                 const Controller& controller, LoopBreak loop_break,
                                                 std::size_t maximum) {
  const LoopCurve loop(channels, delay, controller, loop_break);
  const Eigen::ArrayXd& w = loop.frequency();
  const Eigen::Index size = loop.size_below_nyquist();
  std::vector<LoopQuantity> found;
  double before = std::log(std::norm(loop.on_grid(0)));
  for (Eigen::Index i = 1; i < size; ++i) {
    const double here = std::log(std::norm(loop.on_grid(i)));
    if ((before < 0.0) != (here < 0.0)) {
      const double at = crossing([&](double x) { return std::log(std::norm(loop.at(x))); },
                                 w[i - 1], before, w[i], here);
      const LoopGainPoint point = loop.with_gradient(at);
      const Complex slope = loop.slope(at);
      const double angle = std::arg(-point.value);
      LoopQuantity margin{at, std::abs(angle), {}};
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        const Complex by = point.by_gain[k];
        margin.log_gradient[k] = (by.imag() - slope.imag() * by.real() / slope.real()) / angle;
      }
      found.push_back(margin);
    }
    before = here;
  }
  return smallest(std::move(found), maximum);
}

std::optional<LoopQuantity> position_bandwidth(const LoopChannels& channels, double delay,
                                               const Controller& controller) {
  const LoopCurve loop(channels, delay, controller, LoopBreak::position_loop);
  const Eigen::ArrayXd& w = loop.frequency();
  // ln(2 |S|^2)
  const auto level = [](Complex gain) {
    return std::numbers::ln2 - std::log(std::norm(1.0 + gain));
  };
  double before = level(loop.on_grid(0));
  for (Eigen::Index i = 1; i < w.size(); ++i) {
    const double here = level(loop.on_grid(i));
    if (before < 0.0 && here >= 0.0) {
      const double at =
          crossing([&](double x) { return level(loop.at(x)); }, w[i - 1], before, w[i], here);
      const LoopGainPoint point = loop.with_gradient(at);
      const Complex closed = point.value / (1.0 + point.value);
      const double slope = (closed * loop.slope(at)).real();
      LoopQuantity bandwidth{at, at, {}};
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        bandwidth.log_gradient[k] = -(closed * point.by_gain[k]).real() / slope;
      }
      return bandwidth;
    }
    before = here;
  }
  return std::nullopt;
}

}  // namespace boresight::control
