#include <cmath>

#include <fmt/format.h>

#include <boresight/control/measured/measured_channels.hpp>
#include <boresight/control/measured/measured_points.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

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
                            options.min_resolved >= 0.0 && options.min_resolved <= 1.0 &&
                            options.low_end_factor > 1.0 && options.roll_off > 0.0 &&
                            plant.degrees_of_freedom >= 0.0;
  if (!options_hold) {
    throw InvalidInput(fmt::format(
        "MeasuredChannels: expected coherence and resolved fraction from 0 to 1, a turn between 0 "
        "and "
        "180 degrees, factors and step above 1, a positive roll-off and no negative degrees of "
        "freedom, found {}, {}, {}, {}, {}, {}, {} and {}",
        options.lowest_coherence, options.min_resolved, options.largest_turn_deg,
        options.largest_factor, options.low_end_factor, options.widest_step, options.roll_off,
        plant.degrees_of_freedom));
  }
}

}  // namespace

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
double MeasuredChannels::resolved_fraction() const {
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
  LoopChannels channels;
  channels.response = plant::unset_response(grid);
  for (Index i = 0; i < grid.size(); ++i) plant::set_point(channels.response, i, at(grid[i]));
  channels.at = std::move(at);
  return channels;
}

}  // namespace boresight::control
