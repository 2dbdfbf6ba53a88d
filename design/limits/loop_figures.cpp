#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boresight/design/limits/loop_figures.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using numerics::ComplexLanes;
using numerics::ComplexPack;
using numerics::pack_size;
using numerics::part;
using numerics::RealLanes;
using numerics::RealPack;
using numerics::set_part;

constexpr std::size_t tachometer = 0, encoder = 1, motor_torque = 2, sensors = 3;
// p of the smooth peak: it exceeds the largest |S| by ln(n)/p, n the number of frequencies about as
// high; by 1 % for 55.
constexpr double sharpness = 400.0;
// Of ln |S| below the peak: values from there on count for less than 1e-8 of it.
constexpr double counted = 0.05;

struct Place {
  std::size_t pack, lane;
  explicit Place(Index frequency)
      : pack(static_cast<std::size_t>(frequency) / pack_size),
        lane(static_cast<std::size_t>(frequency) % pack_size) {}
};

Complex at(const ComplexPack& pack, std::size_t lane) {
  return {pack.re[lane], pack.im[lane]};
}

void set(ComplexPack& pack, std::size_t lane, const Complex& value) {
  pack.re.set(lane, value.real());
  pack.im.set(lane, value.imag());
}

// Response and controller at one frequency, and what the tachometer's and the torque's loops leave:
// their return difference.
struct LoopPoint {
  std::array<Complex, sensors> plant, controller;
  Complex inner;

  template <typename Packs>
  LoopPoint(const Packs& packs, const std::vector<SensorPack>& control, Index frequency) {
    const Place place(frequency);
    for (std::size_t i = 0; i < sensors; ++i) {
      plant.at(i) = at(packs[place.pack].response.at(i), place.lane);
      controller.at(i) = at(control[place.pack].at(i), place.lane);
    }
    inner = 1.0 - controller[tachometer] * plant[tachometer] -
            controller[motor_torque] * plant[motor_torque];
  }
  Complex sensitivity() const { return 1.0 / (inner - controller[encoder] * plant[encoder]); }
};

// The smooth peak of a quantity, given the squares of its magnitude. `gradient(frequency)`: of its
// complex logarithm by the controller's response there, twice that of the magnitude's.
template <typename Gradient>
PeakFigure smooth_peak(const std::vector<RealPack>& squares, Index count,
                       const Gradient& gradient) {
  const auto value = [&](Index k) {
    const Place place(k);
    return squares[place.pack][place.lane];
  };
  double top = 0.0;
  for (Index k = 0; k < count; ++k) {
    if (std::isnan(value(k))) return {std::numeric_limits<double>::quiet_NaN(), {}};
    top = std::max(top, value(k));
  }
  const double least = top * std::exp(-2.0 * counted);
  PeakFigure result;
  std::vector<double> powers;
  double sum = 0.0;
  for (Index k = 0; k < count; ++k) {
    if (!(value(k) > least)) continue;
    powers.push_back(std::pow(value(k) / top, 0.5 * sharpness));
    sum += powers.back();
    result.points.push_back({k, gradient(k)});
  }
  result.logarithm = 0.5 * std::log(top) + std::log(sum) / sharpness;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    for (Complex& one : result.points[i].gradient) one *= 0.5 * powers[i] / sum;
  }
  return result;
}

void scale(std::vector<SensorPack>& gradient, double factor) {
  for (SensorPack& pack : gradient) {
    for (ComplexPack& one : pack) one = one * RealPack(factor);
  }
}

}  // namespace

std::vector<SensorPack> packed_response(const Eigen::ArrayXXcd& controller) {
  std::vector<SensorPack> result(numerics::pack_count(static_cast<std::size_t>(controller.rows())));
  for (Index k = 0; k < controller.rows(); ++k) {
    const Place place(k);
    for (std::size_t i = 0; i < sensors; ++i) {
      set(result[place.pack].at(i), place.lane, controller(k, static_cast<Index>(i)));
    }
  }
  return result;
}

// What one pass over the frequencies leaves: |S|^2 at the valve and of the position loop, sums and
// gradients of the mean squares.
struct LoopFigureEvaluator::Sweep {
  std::vector<RealPack> at_valve, of_position;
  RealPack boresight, effort;
  std::vector<SensorPack> by_boresight, by_effort;
};

// With the command u = S K y, a change dK adds d(S K) = S dK + S^2 (dK P) K to it.
template <bool with_rms>
struct LoopFigureEvaluator::Kernel {
  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(const LoopFigureEvaluator& plant,
                                                const std::vector<SensorPack>& controller,
                                                Sweep& sweep) {
    using Real = RealLanes<width>;
    using Lanes = ComplexLanes<width>;
    constexpr std::size_t parts = pack_size / width;
    std::array<Real, parts> boresight{}, effort{};
    for (std::size_t pack = 0; pack < plant.packs_.size(); ++pack) {
      const Pack& on = plant.packs_[pack];
      for (std::size_t q = 0; q < parts; ++q) {
        std::array<Lanes, sensors> k, p;
        for (std::size_t i = 0; i < sensors; ++i) {
          k[i] = part<width>(controller[pack][i], q);
          p[i] = part<width>(on.response[i], q);
        }
        const Lanes inner =
            Lanes{1.0, 0.0} - k[tachometer] * p[tachometer] - k[motor_torque] * p[motor_torque];
        const Lanes all = inner - k[encoder] * p[encoder];
        const Real square = 1.0 / numerics::square(all);
        set_part(sweep.at_valve[pack], q, square);
        set_part(sweep.of_position[pack], q, numerics::square(inner) * square);
        if constexpr (with_rms) {
          const Lanes sensitivity = numerics::conjugate(all) * square;
          std::array<Lanes, sensors> closed, back;
          for (std::size_t i = 0; i < sensors; ++i) {
            closed[i] = k[i] * sensitivity;
            back[i] = numerics::conjugate(closed[i]);
          }
          const Lanes c01 = part<width>(on.covariances[0], q);
          const Lanes c02 = part<width>(on.covariances[1], q);
          const Lanes c12 = part<width>(on.covariances[2], q);
          std::array<Lanes, sensors> seen{
              back[0] * part<width>(on.variances[0], q) + c01 * back[1] + c02 * back[2],
              numerics::conjugate(c01) * back[0] + back[1] * part<width>(on.variances[1], q) +
                  c12 * back[2],
              numerics::conjugate(c02) * back[0] + numerics::conjugate(c12) * back[1] +
                  back[2] * part<width>(on.variances[2], q)};
          const Real by_command = part<width>(on.by_command, q);
          const Real weight = part<width>(on.weight, q);
          Real density = part<width>(on.boresight, q), noise;
          Lanes chained{};
          std::array<Lanes, sensors> noisy;
          for (std::size_t i = 0; i < sensors; ++i) {
            const Lanes cross = part<width>(on.cross[i], q);
            const Lanes answered = seen[i] * by_command;
            density += numerics::real_product(closed[i], cross + cross + answered);
            seen[i] = cross + answered;
            chained = chained + closed[i] * seen[i];
            noisy[i] = back[i] * Real(plant.noise_[i]);
            noise += numerics::square(closed[i]) * Real(plant.noise_[i]);
          }
          boresight[q] += weight * density;
          effort[q] += weight * noise;
          const Lanes weighted = sensitivity * weight;
          for (std::size_t i = 0; i < sensors; ++i) {
            set_part(sweep.by_boresight[pack][i], q, (seen[i] + p[i] * chained) * weighted);
            set_part(sweep.by_effort[pack][i], q, (noisy[i] + p[i] * noise) * weighted);
          }
        }
      }
    }
    for (std::size_t q = 0; q < parts; ++q) {
      set_part(sweep.boresight, q, boresight[q]);
      set_part(sweep.effort, q, effort[q]);
    }
  }
};

LoopFigureEvaluator::LoopFigureEvaluator(const SampledSpectrum& spectrum)
    : packs_(numerics::pack_count(static_cast<std::size_t>(spectrum.weights.size()))),
      count_(spectrum.weights.size()),
      unavoidable_cost_(spectrum.unavoidable_cost) {
  const auto column = [](std::size_t i, std::size_t j) {
    return static_cast<Index>(sensors * i + j);
  };
  for (Index k = 0; k < count_; ++k) {
    const Place place(k);
    Pack& pack = packs_[place.pack];
    for (std::size_t i = 0; i < sensors; ++i) {
      set(pack.response.at(i), place.lane, spectrum.response(k, static_cast<Index>(i)));
      set(pack.cross.at(i), place.lane, spectrum.cross(k, static_cast<Index>(i)));
      pack.variances.at(i).set(place.lane, spectrum.sensors(k, column(i, i)).real());
    }
    set(pack.covariances[0], place.lane, spectrum.sensors(k, column(0, 1)));
    set(pack.covariances[1], place.lane, spectrum.sensors(k, column(0, 2)));
    set(pack.covariances[2], place.lane, spectrum.sensors(k, column(1, 2)));
    pack.boresight.set(place.lane, spectrum.boresight[k]);
    pack.by_command.set(place.lane, spectrum.by_command[k]);
    pack.weight.set(place.lane, spectrum.weights[k]);
  }
  for (std::size_t i = 0; i < sensors; ++i) noise_.at(i) = spectrum.noise[static_cast<Index>(i)];
}

LoopPeaks LoopFigureEvaluator::peaks_of(const Sweep& sweep,
                                        const std::vector<SensorPack>& controller) const {
  const auto scaled = [](const std::array<Complex, sensors>& response, const Complex& factor) {
    return std::array{response[0] * factor, response[1] * factor, response[2] * factor};
  };
  LoopPeaks result;
  result.sensitivity_peak = smooth_peak(sweep.at_valve, count_, [&](Index k) {
    const LoopPoint here(packs_, controller, k);
    return scaled(here.plant, here.sensitivity());
  });
  // The position loop's S = (1 + inner loops) S: it also changes with the inner ones.
  result.position_peak = smooth_peak(sweep.of_position, count_, [&](Index k) {
    const LoopPoint here(packs_, controller, k);
    auto gradient = scaled(here.plant, here.sensitivity());
    for (const std::size_t i : {tachometer, motor_torque}) {
      gradient.at(i) -= here.plant.at(i) / here.inner;
    }
    return gradient;
  });
  return result;
}

LoopPeaks LoopFigureEvaluator::peaks(const std::vector<SensorPack>& controller) const {
  Sweep sweep;
  sweep.at_valve.resize(packs_.size());
  sweep.of_position.resize(packs_.size());
  numerics::run_on_widest_lanes<Kernel<false>>(*this, controller, sweep);
  return peaks_of(sweep, controller);
}

LoopFigures LoopFigureEvaluator::figures(const std::vector<SensorPack>& controller) const {
  Sweep sweep;
  sweep.at_valve.resize(packs_.size());
  sweep.of_position.resize(packs_.size());
  sweep.by_boresight.resize(packs_.size());
  sweep.by_effort.resize(packs_.size());
  numerics::run_on_widest_lanes<Kernel<true>>(*this, controller, sweep);
  const auto figure = [](double mean_square, std::vector<SensorPack>&& gradient) {
    scale(gradient, 0.5 / mean_square);
    return RmsFigure{0.5 * std::log(mean_square), std::move(gradient)};
  };
  return {figure(numerics::sum(sweep.boresight) + unavoidable_cost_, std::move(sweep.by_boresight)),
          figure(numerics::sum(sweep.effort), std::move(sweep.by_effort)),
          peaks_of(sweep, controller)};
}

PeakFigure LoopFigureEvaluator::locked_motor_gain(const std::vector<SensorPack>& controller) const {
  std::vector<RealPack> squares(packs_.size());
  for (Index k = 0; k < count_; ++k) {
    const Place place(k);
    const LoopPoint here(packs_, controller, k);
    squares[place.pack].set(
        place.lane, std::norm(here.controller[encoder] * here.plant[motor_torque] / here.inner));
  }
  return smooth_peak(squares, count_, [&](Index k) {
    const LoopPoint here(packs_, controller, k);
    return std::array{here.plant[tachometer] / here.inner, 1.0 / here.controller[encoder],
                      here.plant[motor_torque] / here.inner};
  });
}

}  // namespace boresight::design
