#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <boresight/control/measured_channels.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::size_t fewest_points = 12;

// a + b w^2 + j c w.
struct LowEnd {
  double constant = 0.0, square = 0.0, odd = 0.0;
  Complex at(double w) const { return {constant + square * w * w, odd * w}; }
};

// Least squares, each value weighted by the inverse of its relative variance.
LowEnd fit_low_end(const std::vector<double>& w, const std::vector<Complex>& value,
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

bool finite(Complex value) {
  return std::isfinite(value.real()) && std::isfinite(value.imag());
}

void check(const OilSpring& oil, double tachometer_corner) {
  if (!(oil.stiffness > 0.0) || !(oil.loss_rate >= 0.0) || !(tachometer_corner > 0.0) ||
      !std::isfinite(oil.stiffness + oil.loss_rate + tachometer_corner)) {
    throw InvalidInput(fmt::format(
        "MeasuredChannels: expected a positive oil stiffness, a loss rate of 0 or more and a "
        "positive corner of the tachometer, found {} N m/rad, {} 1/s and {} rad/s",
        oil.stiffness, oil.loss_rate, tachometer_corner));
  }
}

void check(const MeasuredPlant& plant, const MeasuredChannelOptions& options) {
  const Index count = plant.frequency.size();
  const bool sizes =
      plant.tachometer.size() == count && plant.motor_torque.size() == count &&
      (plant.encoder.size() == 0 || plant.encoder.size() == count) &&
      (plant.covariance.empty() || plant.covariance.size() == static_cast<std::size_t>(count)) &&
      (plant.coherence.size() == 0 ||
       (plant.coherence.rows() == count && plant.coherence.cols() == 3));
  if (!sizes) {
    throw InvalidInput(fmt::format(
        "MeasuredChannels: expected {} values, as many as frequencies, of tachometer and torque, "
        "and of encoder, covariance and coherence (of 3 channels) if given, found {}, {}, {}, {} "
        "and {} x {}",
        count, plant.tachometer.size(), plant.motor_torque.size(), plant.encoder.size(),
        plant.covariance.size(), plant.coherence.rows(), plant.coherence.cols()));
  }
  for (Index i = 0; i < count; ++i) {
    const double w = plant.frequency[i];
    bool numbers = finite(plant.tachometer[i]) && finite(plant.motor_torque[i]) &&
                   (plant.encoder.size() == 0 || finite(plant.encoder[i]));
    if (!plant.covariance.empty()) {
      numbers = numbers && plant.covariance[static_cast<std::size_t>(i)].allFinite();
    }
    if (!(w > 0.0) || !std::isfinite(w)) {
      throw InvalidInput(fmt::format(
          "MeasuredChannels: expected positive frequencies, found {} rad/s at position {}", w, i));
    }
    if (!numbers) {
      throw InvalidInput(
          fmt::format("MeasuredChannels: a response or its covariance at {} rad/s is not finite: "
                      "leave such points out",
                      w));
    }
    for (Index c = 0; c < plant.coherence.cols(); ++c) {
      const double coherence = plant.coherence(i, c);
      if (!(coherence >= 0.0) || !(coherence <= 1.0)) {
        throw InvalidInput(
            fmt::format("MeasuredChannels: expected coherences from 0 to 1, found {} at {} rad/s",
                        coherence, w));
      }
    }
  }
  const bool options_hold = options.lowest_coherence >= 0.0 && options.lowest_coherence <= 1.0 &&
                            options.largest_turn_deg > 0.0 && options.largest_turn_deg < 180.0 &&
                            options.largest_factor > 1.0 && options.widest_step > 1.0 &&
                            options.least_resolved >= 0.0 && options.least_resolved <= 1.0 &&
                            options.low_end_factor > 1.0 && options.roll_off > 0.0 &&
                            plant.degrees_of_freedom >= 0.0;
  if (!options_hold) {
    throw InvalidInput(fmt::format(
        "MeasuredChannels: expected coherence and resolved share from 0 to 1, a turn between 0 and "
        "180 degrees, factors and step above 1, a positive roll-off and no negative degrees of "
        "freedom, found {}, {}, {}, {}, {}, {}, {} and {}",
        options.lowest_coherence, options.least_resolved, options.largest_turn_deg,
        options.largest_factor, options.low_end_factor, options.widest_step, options.roll_off,
        plant.degrees_of_freedom));
  }
}

// Median of the steps around the one after `i`, without that one itself.
double median_step(const std::vector<double>& x, std::size_t i) {
  constexpr std::size_t reach = 5;
  std::vector<double> steps;
  for (std::size_t k = i > reach ? i - reach : 0; k <= i + reach && k + 1 < x.size(); ++k) {
    if (k != i) steps.push_back(x[k + 1] - x[k]);
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

// Three channels: tachometer, torque, encoder, per command.
struct MeasuredChannels::Data {
  OilSpring oil;
  double tachometer_corner = 0.0;
  MeasuredChannelOptions options;
  bool encoder = true, errors = true;
  double degrees_of_freedom = 0.0;
  std::size_t left_out = 0;
  Eigen::ArrayXd frequency;
  std::vector<double> x;                             // ln w
  std::vector<std::array<Complex, 3>> value, slope;  // ln G, its angle followed; by ln w
  std::vector<Eigen::Matrix3cd> relative;            // covariance over G_i conj(G_j)
  std::vector<PointBand> unresolved, encoder_assumed;
  std::vector<bool> encoder_follows;  // a point's, the motor: assumed
  double resolved = 1.0;
  LowEnd tachometer_low, impedance_low, gear_low;

  Complex lag(double w) const { return tachometer_corner / Complex(tachometer_corner, w); }

  std::size_t interval(double place) const {
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, place);
    return static_cast<std::size_t>(above - x.begin()) - 1;
  }

  std::array<Complex, 3> command(double w) const {
    const double place = std::log(w);
    std::array<Complex, 3> result;
    if (place < x.front()) {
      const Complex rate = tachometer_low.at(w) / lag(w);
      return {tachometer_low.at(w), impedance_low.at(w) * rate,
              gear_low.at(w) * rate / Complex(0.0, w)};
    }
    if (place > x.back()) {
      const double fall = -options.roll_off * (place - x.back());
      for (std::size_t c = 0; c < 3; ++c) {
        result[c] = std::exp(value.back()[c] + (c == 2 ? fall - (place - x.back()) : fall));
      }
      return result;
    }
    const std::size_t i = interval(place);
    const double h = x[i + 1] - x[i], t = (place - x[i]) / h;
    const double s = t * t * (3.0 - 2.0 * t);
    for (std::size_t c = 0; c < 3; ++c) {
      result[c] = std::exp(value[i][c] * (1.0 - s) + value[i + 1][c] * s +
                           h * t * (1.0 - t) * (slope[i][c] * (1.0 - t) - slope[i + 1][c] * t));
    }
    return result;
  }

  Eigen::Matrix3cd relative_at(double w) const {
    const double place = std::clamp(std::log(w), x.front(), x.back());
    const std::size_t i = interval(place);
    const double t = (place - x[i]) / (x[i + 1] - x[i]);
    return (1.0 - t) * relative[i] + t * relative[i + 1];
  }

  plant::ResponsePoint with_wind(double w, const std::array<Complex, 3>& by_command) const {
    const Complex s(0.0, w);
    const Complex h = oil.stiffness / (s + oil.loss_rate);
    const auto& [tachometer, torque, angle] = by_command;
    // Y0/(1 + H Y0) with Y0 = rate/torque.
    const Complex rate = tachometer / lag(w);
    const Complex rate_wind = rate / (torque + h * rate);
    plant::ResponsePoint point;
    point.tachometer_command = tachometer;
    point.torque_command = torque;
    point.encoder_command = angle;
    point.tachometer_wind = lag(w) * rate_wind;
    point.torque_wind = -h * rate_wind;
    point.encoder_wind = angle / (torque + h * rate);
    const BendingPoint bending = options.bending ? options.bending(w) : BendingPoint{};
    point.beam_command = bending.beam_per_encoder * angle;
    point.beam_wind = bending.beam_per_encoder * point.encoder_wind + bending.beam_per_wind;
    return point;
  }

  void take_points(const MeasuredPlant& plant);
  void find_unresolved(double lowest_asked, double highest_asked);
  void find_slopes();
  void fit_low();
};

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
  if (!(resolved >= options.least_resolved)) {
    throw NumericalFailure(fmt::format(
        "MeasuredChannels: the usable points resolve {:.0f} % of {:.4g} to {:.4g} Hz, {:.0f} % are "
        "asked for: {} points have a coherence below {:g}. Excite the drive more, or longer",
        100.0 * resolved, lowest_asked / two_pi, highest_asked / two_pi,
        100.0 * options.least_resolved, left_out, options.lowest_coherence));
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

MeasuredChannels::MeasuredChannels(const MeasuredPlant& plant, const OilSpring& oil,
                                   double tachometer_corner,
                                   const MeasuredChannelOptions& options) {
  check(plant, options);
  check(oil, tachometer_corner);
  auto data = std::make_shared<Data>();
  data->oil = oil;
  data->tachometer_corner = tachometer_corner;
  data->options = options;
  data->take_points(plant);
  data->find_unresolved(plant.frequency.minCoeff(), plant.frequency.maxCoeff());
  data->find_slopes();
  data->fit_low();
  data_ = std::move(data);
}

plant::ResponsePoint MeasuredChannels::at(double frequency) const {
  return data_->with_wind(frequency, data_->command(frequency));
}

plant::ResponsePoint MeasuredChannels::changed(double frequency,
                                               const Eigen::Vector3cd& change) const {
  auto by_command = data_->command(frequency);
  for (std::size_t c = 0; c < 3; ++c) by_command[c] += change[static_cast<Index>(c)];
  return data_->with_wind(frequency, by_command);
}

ResponseBasis MeasuredChannels::basis(double frequency) const {
  constexpr double rounding = 1e-12;
  if (frequency < lowest_frequency() * (1.0 - rounding)) return ResponseBasis::assumed_below;
  if (frequency > highest_frequency() * (1.0 + rounding)) return ResponseBasis::assumed_above;
  const auto within = [frequency](const std::vector<PointBand>& bands) {
    const auto next = std::ranges::upper_bound(bands, frequency, {}, &PointBand::lowest);
    return next != bands.begin() && frequency < (next - 1)->highest &&
           frequency > (next - 1)->lowest;
  };
  if (within(data_->unresolved)) return ResponseBasis::unresolved;
  return within(data_->encoder_assumed) ? ResponseBasis::encoder_assumed : ResponseBasis::measured;
}

Eigen::Matrix3cd MeasuredChannels::covariance(double frequency) const {
  Eigen::Matrix3cd result = data_->relative_at(frequency);
  const auto by_command = data_->command(frequency);
  for (Index r = 0; r < 3; ++r) {
    for (Index c = 0; c < 3; ++c) {
      result(r, c) *= by_command[static_cast<std::size_t>(r)] *
                      std::conj(by_command[static_cast<std::size_t>(c)]);
    }
  }
  return result;
}

MeasuredChannels MeasuredChannels::with_oil(const OilSpring& oil) const {
  check(oil, data_->tachometer_corner);
  auto data = std::make_shared<Data>(*data_);
  data->oil = oil;
  return MeasuredChannels(std::move(data));
}

LoopChannels MeasuredChannels::on(const Eigen::ArrayXd& grid) const {
  return sampled_on(grid, [channels = *this](double w) { return channels.at(w); });
}

const Eigen::ArrayXd& MeasuredChannels::frequency() const {
  return data_->frequency;
}
std::size_t MeasuredChannels::points_left_out() const {
  return data_->left_out;
}
const std::vector<PointBand>& MeasuredChannels::unresolved() const {
  return data_->unresolved;
}
const std::vector<PointBand>& MeasuredChannels::encoder_assumed() const {
  return data_->encoder_assumed;
}
double MeasuredChannels::resolved_share() const {
  return data_->resolved;
}
double MeasuredChannels::degrees_of_freedom() const {
  return data_->degrees_of_freedom;
}
bool MeasuredChannels::has_covariance() const {
  return data_->errors;
}
bool MeasuredChannels::has_encoder() const {
  return data_->encoder;
}
const OilSpring& MeasuredChannels::oil() const {
  return data_->oil;
}
double MeasuredChannels::low_end_inertia() const {
  return data_->impedance_low.odd;
}
double MeasuredChannels::low_end_friction() const {
  return data_->impedance_low.constant;
}

LoopChannels sampled_on(const Eigen::ArrayXd& grid,
                        std::function<plant::ResponsePoint(double frequency)> at) {
  const Index count = grid.size();
  LoopChannels channels;
  plant::PlantResponse& response = channels.response;
  response.frequency = grid;
  for (auto* array : {&response.tachometer_command, &response.torque_command,
                      &response.encoder_command, &response.beam_command, &response.tachometer_wind,
                      &response.torque_wind, &response.encoder_wind, &response.beam_wind}) {
    array->resize(count);
  }
  for (Index i = 0; i < count; ++i) {
    const plant::ResponsePoint point = at(grid[i]);
    response.tachometer_command[i] = point.tachometer_command;
    response.torque_command[i] = point.torque_command;
    response.encoder_command[i] = point.encoder_command;
    response.beam_command[i] = point.beam_command;
    response.tachometer_wind[i] = point.tachometer_wind;
    response.torque_wind[i] = point.torque_wind;
    response.encoder_wind[i] = point.encoder_wind;
    response.beam_wind[i] = point.beam_wind;
  }
  channels.at = std::move(at);
  return channels;
}

}  // namespace boresight::control
