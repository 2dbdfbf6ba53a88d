#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/resonance/drive_response_fit.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;

double spread_of(const RealFit& fit, const VectorXd& direction) {
  return std::sqrt(std::max(direction.dot(fit.covariance * direction), 0.0));
}

// Where the excitation is: the widest band about the strongest rate in which the rate, smoothed,
// stays above a hundredth of its maximum and ten times its noise.
struct ExcitedBand {
  double lowest, highest;
};

ExcitedBand excited_band(const WindowedTransforms& rate, double rate_noise, double bin) {
  const Index half = 4;
  VectorXd smooth = VectorXd::Zero(rate.value.size());
  for (Index k = half; k + half < smooth.size(); ++k) {
    smooth(k) = std::sqrt(rate.value.segment(k - half, 2 * half + 1).squaredNorm() / 9.0);
  }
  Index top = 0;
  const double peak = smooth.maxCoeff(&top);
  const double minimum = std::max(0.003 * peak, 6.0 * rate_noise);
  Index low = top, high = top;
  while (low > half && smooth(low - 1) > minimum) --low;
  // An anti-resonance is not the end: look past it by half an octave.
  for (Index k = top; k < std::min<Index>(smooth.size(), 3 * high / 2 + 2); ++k) {
    if (smooth(k) > minimum) high = k;
  }
  return {static_cast<double>(low) * bin, static_cast<double>(high) * bin};
}

}  // namespace

double torque_scale_uncertainty(const DriveRecord& record, const Campaign& campaign) {
  const auto channels =
      static_cast<double>(record.inlet_pressure.size() + record.outlet_pressure.size());
  const auto& knowledge = campaign.knowledge;
  return std::sqrt(
      std::pow(campaign.instruments.pressure_gain, 2) / std::max(channels, 1.0) +
      std::pow(knowledge.torque_efficiency.standard_uncertainty / knowledge.torque_efficiency.value,
               2) +
      std::pow(knowledge.displacement.standard_uncertainty / knowledge.displacement.value, 2));
}

MovingPart moving_part(const DriveRecord& record) {
  const auto& rate = record.motor_rate;
  const Index samples = record.samples();
  VectorXd speed = rate.values.cwiseAbs();
  std::sort(speed.begin(), speed.end());
  const double usual = samples > 0 ? speed(samples * 7 / 10) : 0.0;
  const auto direction = [&](Index i) {
    if (!rate.is_valid(i) || !(std::abs(rate.values(i)) > 0.25 * usual)) return 0;
    return rate.values(i) > 0.0 ? 1 : -1;
  };
  MovingPart longest;
  for (Index i = 0; i < samples;) {
    const int own = direction(i);
    Index end = i + 1;
    while (end < samples && direction(end) == own) ++end;
    if (own != 0 && end - i > longest.samples) longest = {i, end - i};
    i = end;
  }
  const Index margin = std::min<Index>(longest.samples / 4, std::llround(2.0 / record.sample_time));
  // A length with small prime factors, for the transforms.
  Index count = longest.samples - margin;
  while (count > 1 && numerics::fast_transform_length(count) != count) --count;
  return {longest.first + margin, count};
}

DriveResponse drive_response(const DriveRecord& record, const Campaign& campaign,
                             const DriveResponseOptions& options) {
  if (record.inlet_pressure.empty() || record.outlet_pressure.empty()) {
    throw InvalidInput(fmt::format(
        "drive_response: expected inlet and outlet pressures in record '{}', found {} and {}",
        record.name, record.inlet_pressure.size(), record.outlet_pressure.size()));
  }
  const auto& knowledge = campaign.knowledge;
  const double dt = record.sample_time;
  const MovingPart part = moving_part(record);
  DriveResponse result;
  result.record = record.name;
  result.start = static_cast<double>(part.first) * dt;
  result.length = static_cast<double>(part.samples) * dt;
  const double expected_inertia = knowledge.motor_count * knowledge.motor_inertia.value +
                                  knowledge.gear_inertia.value + knowledge.antenna_inertia.value;
  if (part.samples < 1000 || !(expected_inertia > 0.0)) {
    throw NumericalFailure(fmt::format(
        "drive_response: record '{}' moves one way for {:.1f} s at most ({} samples); a fit needs "
        "1000 samples and drawings' inertias above 0",
        record.name, result.length, part.samples));
  }
  const VectorXd torque_signal = recorded_torque(record, knowledge);
  result.mean_rate = record.motor_rate.values.segment(part.first, part.samples).mean();
  result.mean_torque = torque_signal.segment(part.first, part.samples).mean();
  const auto torque = windowed_transforms(torque_signal, part, dt);
  const auto rate = windowed_transforms(record.motor_rate.values, part, dt);
  const double bin = 1.0 / result.length;

  const auto first_noise = bin_noise(rate, torque, 0.2 / dt, bin);
  const auto excited = excited_band(rate, first_noise.rate, bin);
  const auto& locked = knowledge.locked_rotor_frequencies;
  double highest = options.highest_frequency > 0.0 ? options.highest_frequency : excited.highest;
  if (!(options.highest_frequency > 0.0) && !locked.empty()) {
    highest = std::min(highest, 1.6 * locked[std::min(locked.size(), options.max_modes) - 1].value);
  }
  const double lowest = options.lowest_frequency > 0.0 ? options.lowest_frequency
                                                       : std::max(1.5 * excited.lowest, 8.0 * bin);
  if (!(highest > 2.0 * lowest)) {
    throw NumericalFailure(fmt::format(
        "drive_response: record '{}' excites the drive between {:.2f} and {:.2f} Hz only; an "
        "inertia needs an octave",
        record.name, lowest, highest));
  }
  const BinNoise noise = bin_noise(rate, torque, highest, bin);
  const double tolerance = std::log1p(options.frequency_tolerance);
  // Modes in the band are fitted. The lowest one above it bends the impedance already: its inertia
  // is fitted at the structural model's frequency.
  const auto fit_over = [&](double low, double high, double above_band) {
    std::vector<double> centres;
    for (const auto& mode : locked) {
      if (mode.value < 0.9 * high && centres.size() < options.max_modes) {
        centres.push_back(mode.value);
      }
    }
    const auto fitted = static_cast<Index>(centres.size());
    if (centres.empty() && !locked.empty() && high > 0.4 * locked.front().value) {
      centres.push_back(locked.front().value + above_band * locked.front().standard_uncertainty);
    }
    return fit_impedance(
        rate, torque, frequency_band(low, high, bin, rate.value.size()), noise,
        Eigen::Map<const VectorXd>(centres.data(), static_cast<Index>(centres.size())), fitted,
        tolerance);
  };
  const ImpedanceFit fit = fit_over(lowest, highest, 0.0);
  // What the choice of the band does, and the frequency of a mode above it.
  double scatter = 0.0;
  for (const auto& other :
       {fit_over(1.6 * lowest, highest, 0.0), fit_over(lowest, 0.75 * highest, 0.0),
        fit_over(lowest, highest, 1.0)}) {
    scatter = std::max(scatter, std::abs(other.total - fit.total));
  }
  if (!(fit.total > 0.0)) {
    throw NumericalFailure(fmt::format(
        "drive_response: record '{}' gives an inertia of {:.3g} kg m2; torque and rate do not "
        "belong together (signs, units or channels)",
        record.name, fit.total));
  }

  const double scale =
      std::hypot(torque_scale_uncertainty(record, campaign), campaign.instruments.tachometer_scale);
  auto& impedance = result.impedance;
  impedance.lowest_frequency = lowest;
  impedance.highest_frequency = highest;
  const Index unknowns = fit.linear.x.size();
  VectorXd all = VectorXd::Ones(unknowns);
  all(0) = 0.0;
  impedance.inertia =
      scaled_interval(fit.total, std::hypot(spread_of(fit.linear, all), scatter), scale);
  impedance.friction_slope =
      scaled_interval(fit.linear.x(0), std::sqrt(fit.linear.covariance(0, 0)), scale);
  impedance.rigid_inertia = scaled_interval(
      fit.linear.x(1), std::hypot(std::sqrt(fit.linear.covariance(1, 1)), scatter), scale);
  for (Index m = 0; 2 * m < fit.pole_covariance.rows(); ++m) {
    const double frequency = std::exp(fit.poles(2 * m)), zeta = std::exp(fit.poles(2 * m + 1));
    impedance.modes.push_back(
        {numerics::normal_interval(frequency,
                                   frequency * std::sqrt(fit.pole_covariance(2 * m, 2 * m))),
         numerics::normal_interval(zeta,
                                   zeta * std::sqrt(fit.pole_covariance(2 * m + 1, 2 * m + 1))),
         scaled_interval(fit.linear.x(2 + m), std::sqrt(fit.linear.covariance(2 + m, 2 + m)),
                         scale)});
  }

  // Below the structure's modes: above, what the valve commands is no longer what the motors do.
  const double oil_highest =
      locked.empty() ? highest : std::min(highest, 2.0 * locked.front().value);
  const bool oil_shows = shows_oil_relation(lowest, oil_highest, bin);
  if (record.valve_command && !oil_shows) {
    result.notes.push_back(
        fmt::format("{}: excited between {:.2f} Hz and twice the structure's lowest mode, {:.2f} "
                    "Hz: too narrow "
                    "to tell the oil's stiffness, losses and the valve apart",
                    record.name, lowest, oil_highest));
  } else if (record.valve_command) {
    const auto command = windowed_transforms(record.valve_command->values, part, dt);
    OilRelation oil = fit_oil_relation(torque, rate, command, lowest, oil_highest, bin,
                                       torque_scale_uncertainty(record, campaign),
                                       campaign.instruments.tachometer_scale);
    const double k = oil.stiffness.value;
    // The flow is the rate's and the leakage's, which rests on the orifices' fraction: two rounds.
    double leakage = 0.5 * oil.total_loss_rate.value;
    for (int round = 0; round < 6; ++round) {
      const double flow = result.mean_rate + leakage * result.mean_torque / k;
      oil.orifice_loss_rate =
          orifice_loss_rate(record, knowledge, k, flow, part.first, part.samples);
      leakage = oil.total_loss_rate.value - oil.orifice_loss_rate;
    }
    // The fraction of the orifices to 6 %: supply droop and the valve's characteristic.
    oil.leakage_rate = numerics::normal_interval(
        leakage,
        std::hypot(oil.total_loss_rate.standard_uncertainty, 0.06 * oil.orifice_loss_rate));
    result.oil = oil;
    add_hydraulic_mode(result, oil);
  }

  const FrequencyBand band = frequency_band(lowest, highest, bin, rate.value.size());
  const auto columns = impedance_columns(rate, band, fit.poles);
  const VectorXcd model = columns * fit.linear.x;
  const Index points = std::min<Index>(400, band.count / 3);
  result.frequency.resize(points);
  result.measured.resize(points);
  result.fitted.resize(points);
  for (Index p = 0; p < points; ++p) {
    const Index from = p * band.count / points, to = (p + 1) * band.count / points;
    const VectorXcd w = rate.value.segment(band.first + from, to - from);
    const double power = w.squaredNorm();
    result.frequency(p) =
        bin * (static_cast<double>(band.first) + 0.5 * static_cast<double>(from + to - 1));
    result.measured(p) = w.dot(torque.value.segment(band.first + from, to - from)) / power;
    result.fitted(p) = w.dot(model.segment(from, to - from)) / power;
  }
  return result;
}

}  // namespace boresight::identification
