#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/loops/loop_point.hpp>
#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>
#include <boresight/design/ensembles/fixed_gain_panels.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::design {
namespace {

using Complex = std::complex<double>;

plant::ResponsePoint response_at(const plant::AntennaPlant& plant, double w) {
  const plant::Structure& structure = plant.structure;
  plant::StructurePoint seen{-structure.bull_gear_inertia * w * w,
                             {structure.gear_stiffness, structure.gear_damping * w},
                             structure.bull_gear_wind_fraction,
                             structure.bull_gear_beam_weight,
                             0.0};
  for (const auto& mode : structure.modes) {
    const double inertia = mode.inertia * w * w;
    const Complex spring{mode.stiffness, mode.damping * w};
    const Complex own = spring - inertia;
    const Complex inverse = std::conj(own) / std::norm(own);
    const Complex follow = spring * inverse;
    seen.inertial_stiffness -= follow * inertia;
    seen.wind_at_bull_gear += follow * mode.wind_fraction;
    seen.boresight_per_bull_gear += follow * mode.beam_weight;
    seen.boresight_per_wind += inverse * (mode.wind_fraction * mode.beam_weight);
  }
  return plant::drive_on_structure(plant.drive, seen, w);
}

// A point of ln|S|^2 over ln w.
struct LogPoint {
  double place = 0.0, value = 0.0;
};

// Climbs from the highest of three points by parabolas to where they promise no more than `enough`.
template <typename Value>
double top_of(LogPoint left, LogPoint middle, LogPoint right, Value value) {
  constexpr int max_steps = 12;
  constexpr double enough = 1e-7;  // of ln|S|^2
  for (int step = 0; step < max_steps; ++step) {
    const double to_left = left.place - middle.place, to_right = right.place - middle.place;
    const double down_left = left.value - middle.value, down_right = right.value - middle.value;
    const double curvature = (down_right / to_right - down_left / to_left) / (to_right - to_left);
    const double slope = down_left / to_left - curvature * to_left;
    if (!(curvature < 0.0)) break;
    // A step to the very end of the bracket would not shorten it.
    const double shift = std::clamp(-0.5 * slope / curvature, 0.9 * to_left, 0.9 * to_right);
    const double rise = (slope + curvature * shift) * shift;
    if (shift == 0.0 || (rise < enough && step > 0)) break;
    const LogPoint found{middle.place + shift, value(middle.place + shift)};
    const bool beyond = found.place > middle.place;
    if (found.value > middle.value) {
      (beyond ? left : right) = middle;
      middle = found;
    } else {
      (beyond ? right : left) = found;
    }
  }
  return middle.value;
}

}  // namespace

struct FixedGainEvaluator::State {
  TrackingProblem problem;
  control::Controller controller;
  FixedGainOptions options;
  FixedGainPanels panels;

  double sensitivity_square(const plant::AntennaPlant& plant, std::size_t loop_break,
                            double w) const {
    const auto point = control::loop_point(response_at(plant, w), controller, w, problem.delay);
    const double rate = std::norm(point.rate_return), both = std::norm(point.both_return);
    switch (control::loop_breaks.at(loop_break)) {
      case control::LoopBreak::rate_loop_alone:
        return 1.0 / rate;
      case control::LoopBreak::valve_command:
        return 1.0 / both;
      case control::LoopBreak::position_loop:
        break;
    }
    return rate / both;
  }

  double highest_peak(const plant::AntennaPlant& plant, std::size_t loop_break) const {
    std::size_t points = panels.points();
    // Beyond the Nyquist frequency there are images of what is below.
    const double nyquist = control::nyquist_frequency(controller);
    while (points > 0 && !(panels.frequency(points - 1) < nyquist)) --points;
    const auto square = [&](std::size_t i) { return panels.sensitivity_square(loop_break, i); };
    double highest = 1.0;
    for (std::size_t i = 0; i < points; ++i) highest = std::max(highest, square(i));
    // No return turns by more than a right angle between points, and so no peak between them rises
    // far above them: what stands this much lower is not the highest.
    constexpr double lower = 0.25;
    double best = highest;
    for (std::size_t i = 1; i + 1 < points; ++i) {
      const double here = square(i);
      if (here < lower * highest || here <= 1.0 || here < square(i - 1) || here <= square(i + 1)) {
        continue;
      }
      const auto at = [&](std::size_t k) {
        return LogPoint{std::log(panels.frequency(k)), std::log(square(k))};
      };
      const double top = top_of(at(i - 1), at(i), at(i + 1), [&](double place) {
        return std::log(sensitivity_square(plant, loop_break, std::exp(place)));
      });
      best = std::max(best, std::exp(top));
    }
    return std::sqrt(best);
  }
};

FixedGainEvaluator::FixedGainEvaluator(const TrackingProblem& problem,
                                       const control::Controller& controller,
                                       const Constraints& goals, const FixedGainOptions& options) {
  control::validate(controller);
  if (!(options.tolerance > 0.0) || !(options.confirm_peak > 0.0)) {
    throw InvalidInput(
        fmt::format("FixedGainEvaluator: expected a positive tolerance and peak, found {} and {}",
                    options.tolerance, options.confirm_peak));
  }
  state_ = std::make_unique<State>(State{
      problem, controller, options, FixedGainPanels(problem, controller, goals.ask_for_gusts())});
}

FixedGainEvaluator::~FixedGainEvaluator() = default;
FixedGainEvaluator::FixedGainEvaluator(const FixedGainEvaluator& other)
    : state_(std::make_unique<State>(*other.state_)) {}
FixedGainEvaluator& FixedGainEvaluator::operator=(const FixedGainEvaluator& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
FixedGainEvaluator::FixedGainEvaluator(FixedGainEvaluator&& other) noexcept = default;
FixedGainEvaluator& FixedGainEvaluator::operator=(FixedGainEvaluator&& other) noexcept = default;

FixedGainValues FixedGainEvaluator::evaluate(const plant::AntennaPlant& plant) {
  FixedGainPanels& panels = state_->panels;
  panels.sweep(plant, state_->options.tolerance);
  const auto& sums = panels.sums();
  FixedGainValues values{.wind_variance = sums.wind,
                         .climate_variance = sums.climate,
                         .noise_variance = sums.noise,
                         .effort_variance = sums.effort,
                         .wind_demand_variance = sums.demand,
                         .wind_torque_variance = sums.torque,
                         .sensitivity_peaks = {},
                         .stable = panels.stable()};
  for (std::size_t b = 0; b < values.sensitivity_peaks.size(); ++b) {
    values.sensitivity_peaks.at(b) =
        control::has_break(state_->controller, control::loop_breaks.at(b))
            ? state_->highest_peak(plant, b)
            : 1.0;
  }
  return values;
}

bool FixedGainEvaluator::near_the_axis(const FixedGainValues& values) const {
  const auto high = [&](double peak) { return !(peak <= state_->options.confirm_peak); };
  return !values.stable || std::ranges::any_of(values.sensitivity_peaks, high);
}

control::StabilityVerdict FixedGainEvaluator::confirm(const plant::AntennaPlant& plant) {
  state_->panels.sweep(plant, state_->options.tolerance);
  return control::stability(plant, state_->controller, state_->problem.delay, frequencies());
}

const control::Controller& FixedGainEvaluator::controller() const {
  return state_->controller;
}

Eigen::ArrayXd FixedGainEvaluator::frequencies() const {
  const FixedGainPanels& panels = state_->panels;
  Eigen::ArrayXd frequency(static_cast<Eigen::Index>(panels.points()));
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    frequency[i] = panels.frequency(static_cast<std::size_t>(i));
  }
  return frequency;
}

}  // namespace boresight::design
