#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include <boresight/identification/resonance/drive_response.hpp>
#include <boresight/identification/resonance/hydraulic_ring.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Mean over `span` samples from each sample on, less that of the span before it.
VectorXd mean_change(const VectorXd& signal, Index span) {
  VectorXd running(signal.size() + 1);
  running(0) = 0.0;
  for (Index i = 0; i < signal.size(); ++i) running(i + 1) = running(i) + signal(i);
  VectorXd change = VectorXd::Zero(signal.size());
  for (Index i = span; i + span <= signal.size(); ++i) {
    change(i) =
        (running(i + span) - 2.0 * running(i) + running(i - span)) / static_cast<double>(span);
  }
  return change;
}

// K w + dT/dt: the valve's flow times K but for the loss, which changes slowly.
VectorXd flow_from_motion(const DriveRecord& record, const DriveKnowledge& knowledge,
                          double stiffness) {
  const VectorXd torque = recorded_torque(record, knowledge);
  VectorXd flow = stiffness * record.motor_rate.values;
  for (Index i = 1; i + 1 < flow.size(); ++i) {
    flow(i) += (torque(i + 1) - torque(i - 1)) / (2.0 * record.sample_time);
  }
  return flow;
}

struct RingWindow {
  Index first, samples;
};

// Why a window cannot be used; empty if it can.
std::string unusable(const DriveRecord& record, const RingWindow& window, Index before) {
  const auto& rate = record.motor_rate;
  const Index from = std::max<Index>(window.first - before, 0);
  const VectorXd own = rate.values.segment(from, window.first + window.samples - from);
  const double mean = own.mean();
  if ((own.array() * (mean < 0.0 ? -1.0 : 1.0)).minCoeff() < 0.2 * std::abs(mean)) {
    return "the drive is not moving one way";
  }
  for (Index i = window.first; i < window.first + window.samples; ++i) {
    if (!rate.is_valid(i)) return "the rate is not valid throughout";
  }
  const auto all_valid = [&](const std::vector<Signal>& signals) {
    return std::all_of(signals.begin(), signals.end(), [&](const Signal& signal) {
      Index lost = 0;
      for (Index i = window.first; i < window.first + window.samples; ++i) {
        lost += signal.is_valid(i) ? 0 : 1;
      }
      return 50 * lost <= window.samples;
    });
  };
  if (!all_valid(record.inlet_pressure) || !all_valid(record.outlet_pressure)) {
    return "more than 2 % of a pressure's samples are not valid";
  }
  return {};
}

// Stiffness and loss that a pole s and a shape r = torque/rate make: s r + lambda r = -K.
struct OilFromShape {
  double stiffness, loss;
};

OilFromShape oil_from_shape(std::complex<double> s, std::complex<double> r) {
  const std::complex<double> product = s * r;
  const double loss = -product.imag() / r.imag();
  return {-product.real() - loss * r.real(), loss};
}

struct Spread {
  double stiffness, loss;
};

// First order, by differences over the fit's six numbers of this mode.
Spread shape_spread(const RingFit& fit, std::size_t modes) {
  const auto& mode = fit.modes.front();
  const double w = two_pi * mode.pole.damped_frequency, decay = mode.pole.decay_rate;
  const auto at = [&](const Eigen::Matrix<double, 6, 1>& x) {
    const std::complex<double> s(-decay * std::exp(x(1)), w * std::exp(x(0)));
    const std::complex<double> torque = mode.amplitude(0) + std::complex<double>(x(2), x(3));
    const std::complex<double> rate = mode.amplitude(1) + std::complex<double>(x(4), x(5));
    return oil_from_shape(s, torque / rate);
  };
  const auto modal = 2 * static_cast<Index>(modes);
  const std::array<Index, 6> place{0, 1, modal, modal + 1, 2 * modal, 2 * modal + 1};
  Eigen::Matrix<double, 6, 6> covariance;
  for (Index i = 0; i < 6; ++i) {
    for (Index j = 0; j < 6; ++j) {
      covariance(i, j) =
          fit.covariance(place[static_cast<std::size_t>(i)], place[static_cast<std::size_t>(j)]);
    }
  }
  Eigen::Matrix<double, 6, 1> stiffness, loss;
  for (Index k = 0; k < 6; ++k) {
    const double size = k < 2 ? 1.0 : std::abs(mode.amplitude(k < 4 ? 0 : 1));
    Eigen::Matrix<double, 6, 1> up = Eigen::Matrix<double, 6, 1>::Zero(), down = up;
    up(k) = 1e-5 * size;
    down(k) = -1e-5 * size;
    const auto above = at(up), below = at(down);
    stiffness(k) = (above.stiffness - below.stiffness) / (2e-5 * size);
    loss(k) = (above.loss - below.loss) / (2e-5 * size);
  }
  return {std::sqrt(std::max(stiffness.dot(covariance * stiffness), 0.0)),
          std::sqrt(std::max(loss.dot(covariance * loss), 0.0))};
}

// A ring far from all others' frequency is another thing: the valve was still moving, or the drive
// had just broken away.
void drop_strangers(StepRings& result) {
  if (result.rings.size() < 4) return;
  VectorXd frequencies(static_cast<Index>(result.rings.size()));
  for (std::size_t k = 0; k < result.rings.size(); ++k) {
    frequencies(static_cast<Index>(k)) = result.rings[k].frequency.value;
  }
  const double usual = numerics::median(frequencies);
  const double spread = 1.4826 * numerics::median(VectorXd((frequencies.array() - usual).abs()));
  const double maximum = std::max(5.0 * spread, 0.03 * usual);
  std::erase_if(result.rings, [&](const StepRing& ring) {
    const bool strange = std::abs(ring.frequency.value - usual) > maximum;
    if (strange) {
      result.notes.push_back(fmt::format(
          "step at {:.2f} s left out: it rings at {:.3f} Hz, the others about {:.3f} Hz", ring.time,
          ring.frequency.value, usual));
    }
    return strange;
  });
}

}  // namespace

std::vector<double> valve_step_times(const DriveRecord& record, const DriveKnowledge& knowledge,
                                     double stiffness, double threshold) {
  const bool recorded = record.valve_command.has_value();
  const VectorXd signal = record.valve_command ? record.valve_command->values
                                               : flow_from_motion(record, knowledge, stiffness);
  const auto span = std::max<Index>(4, std::llround((recorded ? 0.05 : 0.08) / record.sample_time));
  std::vector<double> times;
  if (signal.size() < 4 * span) return times;
  const VectorXd change = mean_change(signal, span).cwiseAbs();
  // 1.4826 times the median of |x| is a normal's standard deviation.
  const double minimum =
      threshold * std::max(1.4826 * numerics::median(change), 1e-9 * change.maxCoeff());
  const Index apart = 6 * span;
  for (Index i = span; i + span < change.size(); ++i) {
    const Index from = std::max<Index>(i - apart, 0);
    Index top = 0;
    const double largest =
        change.segment(from, std::min<Index>(2 * apart + 1, change.size() - from)).maxCoeff(&top);
    // Of a step nothing is left two spans away; of a ramp all.
    const double beside = std::max(change(std::max<Index>(i - 2 * span, 0)),
                                   change(std::min<Index>(i + 2 * span, change.size() - 1)));
    if (change(i) >= std::max(minimum, 3.0 * beside) && largest <= change(i) && from + top == i) {
      times.push_back(static_cast<double>(i) * record.sample_time);
    }
  }
  return times;
}

StepRings fit_step_rings(const DriveRecord& record, const Campaign& campaign, double stiffness,
                         const StepRingOptions& options) {
  const double expected = options.expected_frequency;
  if (!(expected > 0.0) || !(stiffness > 0.0)) {
    throw InvalidInput(fmt::format(
        "fit_step_rings: expected a positive frequency to look about and a positive stiffness, "
        "found {} Hz and {} N m/rad",
        expected, stiffness));
  }
  const auto& knowledge = campaign.knowledge;
  if (!(options.highest_fraction * expected < 0.45 / record.sample_time)) {
    throw NumericalFailure(
        fmt::format("fit_step_rings: record '{}' has {:.3g} samples/s; a ringing up to {:.3g} Hz "
                    "needs more than "
                    "{:.3g}",
                    record.name, 1.0 / record.sample_time, options.highest_fraction * expected,
                    options.highest_fraction * expected / 0.45));
  }
  const double dt = record.sample_time;
  const VectorXd torque = recorded_torque(record, knowledge);
  const auto times = valve_step_times(record, knowledge, stiffness, options.step_threshold);
  StepRings result;
  const auto& locked = knowledge.locked_rotor_frequencies;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double settled = times[k] + std::max(options.settling_time, 1.0 / (30.0 * expected));
    const double end =
        k + 1 < times.size() ? times[k + 1] - 0.06 : static_cast<double>(record.samples()) * dt;
    const double length = std::min(options.periods / expected, end - settled);
    const RingWindow window{static_cast<Index>(std::llround(settled / dt)),
                            static_cast<Index>(std::floor(length / dt)) - 1};
    if (length < 0.8 * options.periods / expected) {
      result.notes.push_back(fmt::format(
          "step at {:.2f} s left out: {:.2f} s until the next or the end, {:.2f} needed", times[k],
          end - settled, 0.8 * options.periods / expected));
      continue;
    }
    const auto before = static_cast<Index>(std::llround(0.5 / (expected * dt)));
    if (const std::string why = unusable(record, window, before); !why.empty()) {
      result.notes.push_back(fmt::format("step at {:.2f} s left out: {}", times[k], why));
      continue;
    }
    Eigen::MatrixXd signals(window.samples, 2);
    signals.col(0) = torque.segment(window.first, window.samples);
    signals.col(1) = record.motor_rate.values.segment(window.first, window.samples);
    auto starts = ring_starts(signals, dt, 1, options.lowest_fraction * expected,
                              options.highest_fraction * expected);
    if (starts.empty()) starts.push_back({expected, 0.2 * two_pi * expected});
    RingFitOptions structural;
    structural.largest_damping_ratio = 0.1;
    structural.low_frequency_limit = options.highest_fraction * expected;
    const double lowest =
        locked.empty() ? 2.0 * expected
                       : std::max(0.9 * locked.front().value, structural.low_frequency_limit);
    const double highest = locked.empty() ? 6.0 * expected : 1.7 * locked.front().value;
    if (lowest < highest && highest < 0.4 / dt) {
      const auto more = ring_starts(signals, dt, 1, lowest, highest, structural);
      starts.insert(starts.end(), more.begin(), more.end());
    }
    // Too few samples for the structure's mode beside the oil's: then the oil's alone.
    if (!can_fit_rings(window.samples, dt, starts.size())) starts.resize(1);
    if (!can_fit_rings(window.samples, dt, starts.size())) {
      result.notes.push_back(
          fmt::format("step at {:.2f} s left out: {} samples until it has rung out, too few to "
                      "fit; record more "
                      "a second",
                      times[k], window.samples));
      continue;
    }
    const RingFit fit = fit_damped_cosines(signals, dt, starts);
    const auto& mode = fit.modes.front();
    const double f = mode.natural_frequency.value;
    if (!(f > options.lowest_fraction * expected) || !(f < options.highest_fraction * expected) ||
        mode.natural_frequency.standard_uncertainty > 0.1 * f ||
        std::abs(mode.amplitude(0)) < 3.0 * fit.residual_rms(0)) {
      result.notes.push_back(fmt::format(
          "step at {:.2f} s left out: no ringing between {:.2f} and {:.2f} Hz stands out", times[k],
          options.lowest_fraction * expected, options.highest_fraction * expected));
      continue;
    }
    StepRing ring;
    ring.time = times[k];
    ring.mean_rate = signals.col(1).mean();
    ring.mean_torque = signals.col(0).mean();
    ring.frequency = mode.natural_frequency;
    ring.damping_ratio = mode.damping_ratio;
    ring.pole = mode.pole;
    ring.torque_over_rate = mode.amplitude(0) / mode.amplitude(1);
    const auto oil = oil_from_shape({-mode.pole.decay_rate, two_pi * mode.pole.damped_frequency},
                                    ring.torque_over_rate);
    const auto spread = shape_spread(fit, fit.modes.size());
    if (!std::isfinite(oil.stiffness) || !std::isfinite(spread.stiffness) ||
        !std::isfinite(oil.loss) || !std::isfinite(spread.loss)) {
      result.notes.push_back(fmt::format(
          "step at {:.2f} s left out: torque and rate swing in phase, as they do in no oil spring",
          times[k]));
      continue;
    }
    ring.stiffness = oil.stiffness;
    ring.total_loss_rate = oil.loss;
    ring.stiffness_uncertainty = spread.stiffness;
    ring.loss_uncertainty = spread.loss;
    const double flow = ring.mean_rate + 0.5 * oil.loss * ring.mean_torque / stiffness;
    const double orifices =
        orifice_loss_rate(record, knowledge, stiffness, flow, window.first, window.samples);
    ring.leakage_rate = oil.loss - orifices;
    if (result.rings.empty()) {
      result.plot_fitted = fit.oscillation;
      result.plot_signals = fit.oscillation + fit.residual;
      result.plot_time =
          VectorXd::LinSpaced(window.samples, 0.0, static_cast<double>(window.samples - 1) * dt);
    }
    result.rings.push_back(ring);
  }
  if (result.rings.empty()) {
    throw NumericalFailure(fmt::format(
        "fit_step_rings: none of {} steps of record '{}' leaves a ringing between {:.2f} and "
        "{:.2f} Hz about a moving operating point{}{}",
        times.size(), record.name, options.lowest_fraction * expected,
        options.highest_fraction * expected,
        result.notes.empty() ? "" : "; first: ", result.notes.empty() ? "" : result.notes.front()));
  }
  drop_strangers(result);
  std::vector<numerics::Uncertain> frequencies, dampings, stiffnesses, losses, leakages;
  const auto positive = [](double uncertainty, double value) {
    return std::max(uncertainty, 1e-6 * std::abs(value) + 1e-12);
  };
  for (const auto& ring : result.rings) {
    const auto& f = ring.frequency;
    const auto& zeta = ring.damping_ratio;
    frequencies.push_back({f.value, positive(f.standard_uncertainty, f.value)});
    dampings.push_back({zeta.value, positive(zeta.standard_uncertainty, zeta.value)});
    stiffnesses.push_back({ring.stiffness, positive(ring.stiffness_uncertainty, ring.stiffness)});
    const double u_loss = positive(ring.loss_uncertainty, ring.total_loss_rate);
    losses.push_back({ring.total_loss_rate, u_loss});
    leakages.push_back({ring.leakage_rate, u_loss});
  }
  const auto interval = [](const numerics::PooledMean& pooled, double relative) {
    return numerics::normal_interval(pooled.mean.value, std::hypot(pooled.mean.standard_uncertainty,
                                                                   relative * pooled.mean.value));
  };
  const auto frequency = numerics::pooled_mean(frequencies);
  result.frequency = interval(frequency, 0.0);
  result.frequency_between = frequency.between;
  result.damping_ratio = interval(numerics::pooled_mean(dampings), 0.0);
  const double scale =
      std::hypot(torque_scale_uncertainty(record, campaign), campaign.instruments.tachometer_scale);
  result.stiffness = interval(numerics::pooled_mean(stiffnesses), scale);
  result.total_loss_rate = interval(numerics::pooled_mean(losses), 0.0);
  const auto leakage = numerics::pooled_mean(leakages);
  const double orifices = result.total_loss_rate.value - leakage.mean.value;
  result.leakage_rate = numerics::normal_interval(
      leakage.mean.value, std::hypot(leakage.mean.standard_uncertainty, 0.06 * orifices,
                                     0.05 * result.total_loss_rate.value));
  return result;
}

}  // namespace boresight::identification
