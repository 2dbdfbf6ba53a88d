#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <boresight/control/measured/measured_points.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr std::size_t fewest_points = 12;

// Least squares, each value weighted by the inverse of its relative variance.
LowEndFit fit_low_end(const std::vector<double>& w, const std::vector<Complex>& value,
                      const std::vector<double>& weight) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, r0 = 0.0, r1 = 0.0, odd = 0.0, odd_square = 0.0;
  const double unit = w.back();
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double x = w[i] / unit, square = x * x;
    s0 += weight[i];
    s1 += weight[i] * square;
    s2 += weight[i] * square * square;
    r0 += weight[i] * value[i].real();
    r1 += weight[i] * square * value[i].real();
    odd += weight[i] * x * value[i].imag();
    odd_square += weight[i] * square;
  }
  const double determinant = s0 * s2 - s1 * s1;
  return {(r0 * s2 - r1 * s1) / determinant, (s0 * r1 - s1 * r0) / determinant / (unit * unit),
          odd / odd_square / unit};
}

// Median of the steps around the one after `i`, without that one itself.
double median_step(const std::vector<double>& x, std::size_t i) {
  constexpr std::size_t reach = 5;
  std::vector<double> steps;
  for (std::size_t k = i > reach ? i - reach : 0; k <= i + reach && k + 1 < x.size(); ++k) {
    if (k != i) steps.push_back(x[k + 1] - x[k]);
  }
  return numerics::median(std::move(steps));
}

}  // namespace

void MeasuredChannels::Data::take_points(const MeasuredPlant& plant) {
  const Index count = plant.frequency.size();
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order,
                    [&](Index i, Index k) { return plant.frequency[i] < plant.frequency[k]; });
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    if (plant.frequency[order[k]] == plant.frequency[order[k + 1]]) {
      throw InvalidInput(
          fmt::format("MeasuredChannels: expected each frequency once, found {} "
                      "rad/s twice: average such points first",
                      plant.frequency[order[k]]));
    }
  }
  encoder = plant.encoder.size() > 0;
  errors = !plant.covariance.empty();
  degrees_of_freedom = plant.degrees_of_freedom;
  std::vector<double> usable;
  std::optional<Complex> gear;  // encoder rate over motor rate where the encoder was last coherent
  const auto is_coherent = [&](Index i, Index channel) {
    return plant.coherence.size() == 0 || plant.coherence(i, channel) >= options.lowest_coherence;
  };
  const auto motor_angle = [&](Index i) {
    const double w = plant.frequency[i];
    return plant.tachometer[i] / (lag(w) * Complex(0.0, w));
  };
  const auto is_usable = [&](Index i) {
    return is_coherent(i, 0) && is_coherent(i, 1) && plant.tachometer[i] != 0.0 &&
           plant.motor_torque[i] != 0.0;
  };
  const auto has_angle = [&](Index i) {
    return !encoder || (is_coherent(i, 2) && plant.encoder[i] != 0.0);
  };
  for (const Index i : order) {
    if (!is_usable(i)) {
      ++left_out;
      continue;
    }
    const bool measured = has_angle(i);
    if (measured) gear = encoder ? plant.encoder[i] / motor_angle(i) : 1.0;
    if (!gear) {
      // The lowest of all: what the next coherent point says.
      const auto next = std::ranges::find_if(order, [&](Index k) {
        return plant.frequency[k] > plant.frequency[i] && is_usable(k) && has_angle(k);
      });
      if (next == order.end()) {
        throw NumericalFailure(fmt::format(
            "MeasuredChannels: the encoder has a coherence below {:g} wherever tachometer and "
            "torque have more. Leave it out to have it taken for the motor's angle",
            options.lowest_coherence));
      }
      gear = plant.encoder[*next] / motor_angle(*next);
    }
    const std::array<Complex, 3> here{
        plant.tachometer[i], plant.motor_torque[i],
        measured && encoder ? plant.encoder[i] : *gear * motor_angle(i)};
    usable.push_back(plant.frequency[i]);
    x.push_back(std::log(plant.frequency[i]));
    encoder_follows.push_back(!measured);
    std::array<Complex, 3> logarithm;
    for (std::size_t c = 0; c < 3; ++c) logarithm[c] = std::log(here[c]);
    value.push_back(logarithm);
    Eigen::Matrix3cd ratio = Eigen::Matrix3cd::Zero();
    if (errors) {
      ratio = plant.covariance[static_cast<std::size_t>(i)];
      for (Index r = 0; r < 3; ++r) {
        for (Index c = 0; c < 3; ++c) {
          ratio(r, c) /=
              here[static_cast<std::size_t>(r)] * std::conj(here[static_cast<std::size_t>(c)]);
        }
      }
      if (!encoder || !measured) {
        // The motor's angle has the tachometer's errors; beside them its own where it is assumed.
        ratio.row(2) = ratio.row(0);
        ratio.col(2) = ratio.col(0);
        ratio(2, 2) = ratio(0, 0) + (measured ? 0.0 : 1.0);
      }
    }
    relative.push_back(ratio);
  }
  frequency = Eigen::Map<Eigen::ArrayXd>(usable.data(), static_cast<Index>(usable.size()));
  if (usable.size() < fewest_points) {
    throw NumericalFailure(fmt::format(
        "MeasuredChannels: {} of {} points are usable, {} are needed: the others have a coherence "
        "below {:g} or a response of 0. Excite the drive more, or longer",
        usable.size(), count, fewest_points, options.lowest_coherence));
  }
}

void MeasuredChannels::Data::find_unresolved(double lowest_asked, double highest_asked) {
  const double largest_turn = options.largest_turn_deg * two_pi / 360.0;
  const double largest_step = std::log(options.largest_factor);
  double lost = x.front() - std::log(lowest_asked) + std::log(highest_asked) - x.back();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    bool resolved_here = x[i + 1] - x[i] <= options.widest_step * median_step(x, i);
    for (std::size_t c = 0; c < 3; ++c) {
      const double from = value[i][c].imag(), to = value[i + 1][c].imag();
      const double turn = std::remainder(to - from, two_pi);
      value[i + 1][c].imag(from + turn);
      resolved_here = resolved_here && std::abs(turn) <= largest_turn &&
                      std::abs(value[i + 1][c].real() - value[i][c].real()) <= largest_step;
    }
    if (encoder_follows[i] || encoder_follows[i + 1]) {
      const double from = std::exp(x[i]), to = std::exp(x[i + 1]);
      if (encoder_assumed.empty() || encoder_assumed.back().highest != from) {
        encoder_assumed.push_back({from, to});
      } else {
        encoder_assumed.back().highest = to;
      }
    }
    if (resolved_here) continue;
    lost += x[i + 1] - x[i];
    unresolved.push_back({std::exp(x[i]), std::exp(x[i + 1])});
  }
  resolved = 1.0 - lost / std::log(highest_asked / lowest_asked);
  if (!(resolved >= options.min_resolved)) {
    throw NumericalFailure(fmt::format(
        "MeasuredChannels: the usable points resolve {:.0f} % of {:.4g} to {:.4g} Hz, {:.0f} % are "
        "asked for: {} points have a coherence below {:g}. Excite the drive more, or longer",
        100.0 * resolved, lowest_asked / two_pi, highest_asked / two_pi,
        100.0 * options.min_resolved, left_out, options.lowest_coherence));
  }
}

// Derivative at each point of the parabola through three, it one of them.
void MeasuredChannels::Data::find_slopes() {
  const std::size_t count = x.size();
  slope.resize(count);
  const auto secant = [&](std::size_t i, std::size_t c) {
    return (value[i + 1][c] - value[i][c]) / (x[i + 1] - x[i]);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = std::clamp<std::size_t>(i, 1, count - 2);
    for (std::size_t c = 0; c < 3; ++c) {
      const Complex bend = (secant(k, c) - secant(k - 1, c)) / (x[k + 1] - x[k - 1]);
      slope[i][c] = secant(k - 1, c) + bend * (2.0 * x[i] - x[k - 1] - x[k]);
    }
  }
}

void MeasuredChannels::Data::fit_low() {
  std::vector<double> w, weight;
  std::vector<Complex> tachometer, impedance, gear;
  constexpr std::size_t fewest = 4;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double here = frequency[static_cast<Index>(i)];
    if (here > frequency[0] * options.low_end_factor && w.size() >= fewest) break;
    const Complex rate = std::exp(value[i][0]) / lag(here);
    w.push_back(here);
    tachometer.push_back(std::exp(value[i][0]));
    impedance.push_back(std::exp(value[i][1]) / rate);
    gear.push_back(std::exp(value[i][2]) * Complex(0.0, here) / rate);
    const double variance = relative[i].diagonal().real().sum();
    weight.push_back(errors ? 1.0 / std::max(variance, 1e-12) : 1.0);
  }
  tachometer_low = fit_low_end(w, tachometer, weight);
  impedance_low = fit_low_end(w, impedance, weight);
  gear_low = fit_low_end(w, gear, weight);
  if (!(tachometer_low.constant > 0.0) || !(gear_low.constant > 0.0)) {
    throw InvalidInput(fmt::format(
        "MeasuredChannels: towards low frequency the tachometer goes to {:.3g} times the command "
        "and the encoder's rate to {:.3g} times the motor's: expected both positive. Turn the sign "
        "of a column that is recorded reversed",
        tachometer_low.constant, gear_low.constant));
  }
}

}  // namespace boresight::control
