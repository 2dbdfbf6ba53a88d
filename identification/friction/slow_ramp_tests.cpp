#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/friction/friction_tests.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/identification/signals/rate_smoothing.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

constexpr double smoothing_time = 0.1;  // s, of the rate that motion is detected by

Eigen::VectorXd mean_pressures(const DriveRecord& record, Eigen::Index first, Eigen::Index count) {
  Eigen::VectorXd mean(
      static_cast<Eigen::Index>(record.inlet_pressure.size() + record.outlet_pressure.size()));
  Eigen::Index channel = 0;
  for (const auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (const auto& signal : *side) mean(channel++) = signal.values.segment(first, count).mean();
  }
  return mean;
}

void find_breakaways(const Campaign& campaign, std::size_t index,
                     const FrictionTestOptions& options, std::vector<Breakaway>& found) {
  const auto& record = campaign.records[index];
  const auto samples = [&](double time) {
    return std::max<Eigen::Index>(
        1, static_cast<Eigen::Index>(std::lround(time / record.sample_time)));
  };
  const Eigen::Index around = samples(0.5 * smoothing_time);
  const Eigen::Index after = samples(options.after_breakaway);
  const Eigen::VectorXd rate = moving_mean(record.motor_rate.values, around);
  const double noise =
      noise_level(record.motor_rate.values) / std::sqrt(static_cast<double>(2 * around + 1));
  const double threshold =
      std::max(options.rest_fraction * rate.cwiseAbs().maxCoeff(), 5.0 * noise);
  const auto usable = usable_samples(record, options.guard_time);
  Eigen::Index rested = 0;
  for (Eigen::Index i = 0; i + after <= record.samples(); ++i) {
    if (std::abs(rate(i)) < threshold) {
      ++rested;
      continue;
    }
    const bool starts = rested >= samples(options.rest_time) && i >= around;
    rested = 0;
    if (!starts) continue;
    const int direction = rate(i) > 0.0 ? 1 : -1;
    // A slip that sticks again is no breakaway into motion.
    const auto path = rate.segment(i, after);
    const bool moves =
        direction > 0 ? path.minCoeff() >= 0.9 * threshold : path.maxCoeff() <= -0.9 * threshold;
    const bool clean = std::all_of(usable.begin() + (i - around), usable.begin() + (i + after),
                                   [](bool sample) { return sample; });
    if (!moves || !clean) continue;
    found.push_back({index, i, direction, 0.0, 0.0,
                     mean_pressures(record, i - around, 2 * around + 1),
                     mean_pressures(record, i, after)});
  }
}

// Mean of up, mean of down.
struct Sides {
  double up = 0.0, down = 0.0;
  double up_uncertainty = 0.0, down_uncertainty = 0.0;
};

Sides sides(const std::vector<Breakaway>& breakaways, double Breakaway::*torque) {
  Sides result;
  for (int direction : {1, -1}) {
    double sum = 0.0, square = 0.0, count = 0.0;
    for (const auto& one : breakaways) {
      if (one.direction != direction) continue;
      sum += one.*torque;
      square += one.*torque * (one.*torque);
      count += 1.0;
    }
    const double mean = sum / count;
    const double variance =
        count > 1.0 ? std::max(0.0, square - count * mean * mean) / (count * (count - 1.0)) : 0.0;
    (direction > 0 ? result.up : result.down) = mean;
    (direction > 0 ? result.up_uncertainty : result.down_uncertainty) = std::sqrt(variance);
  }
  return result;
}

}  // namespace

SlowRampTests slow_ramp_tests(const Campaign& campaign, const FrictionTestOptions& options) {
  if (!(options.after_breakaway > 0.0) || !(options.rest_fraction > 0.0) ||
      !(options.rest_fraction < 1.0) || !(options.rest_time > 0.0) || options.random_samples < 20) {
    throw InvalidInput(fmt::format(
        "slow_ramp_tests: expected positive times, a rest fraction between 0 and 1 and at "
        "least 20 samples, found {}, {}, {}, {}",
        options.after_breakaway, options.rest_time, options.rest_fraction, options.random_samples));
  }
  SlowRampTests tests;
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    const auto& record = campaign.records[index];
    if (record.test != TestKind::slow_ramp || record.samples() < 20) continue;
    find_breakaways(campaign, index, options, tests.breakaways);
  }
  const auto starts = [&](int direction) {
    return std::count_if(tests.breakaways.begin(), tests.breakaways.end(),
                         [&](const Breakaway& one) { return one.direction == direction; });
  };
  if (starts(1) == 0 || starts(-1) == 0) {
    throw NumericalFailure(
        fmt::format("slow_ramp_tests: expected starts from rest both ways, found {} up and {} "
                    "down; record a slow triangle of the rate through zero",
                    starts(1), starts(-1)));
  }
  const double scale = torque_per_pressure(campaign.knowledge);
  const auto measure = [&](const InstrumentErrors& errors) {
    for (auto& one : tests.breakaways) {
      const auto inlets =
          static_cast<Eigen::Index>(campaign.records[one.record].inlet_pressure.size());
      one.torque = torque_impulse(one.pressure, inlets, 1.0, scale, errors);
      one.torque_after = torque_impulse(one.pressure_after, inlets, 1.0, scale, errors);
    }
  };
  const InstrumentErrors exact = no_instrument_errors(channel_count(campaign));
  measure(exact);
  const Sides start = sides(tests.breakaways, &Breakaway::torque);
  const Sides after = sides(tests.breakaways, &Breakaway::torque_after);
  const auto half_difference = [](const Sides& s) { return 0.5 * (s.up - s.down); };
  const auto half_sum = [](const Sides& s) { return 0.5 * (s.up + s.down); };
  const Eigen::Index count = options.random_samples;
  Eigen::VectorXd breakaway(count), coulomb(count), offset(count);
  for (auto* random_samples : {&tests.by_transducers, &tests.by_scatter}) {
    *random_samples = {Eigen::VectorXd(count), Eigen::VectorXd::Zero(count),
                       Eigen::VectorXd(count)};
  }
  for (Eigen::Index draw = 0; draw < count; ++draw) {
    const auto number = static_cast<std::uint64_t>(draw);
    const numerics::NormalNumbers normal(options.seed + 2, number);
    const auto noise = [&](const Sides& s, std::uint64_t index) {
      const auto pair = normal.pair(index);
      return Sides{s.up_uncertainty * pair.real(), s.down_uncertainty * pair.imag()};
    };
    InstrumentErrors errors = draw_instrument_errors(campaign, options.seed, number);
    const double scale_error = 1.0 + errors.torque_scale;
    errors.torque_scale = 0.0;
    measure(errors);
    const Sides drawn_start = sides(tests.breakaways, &Breakaway::torque);
    const Sides drawn_after = sides(tests.breakaways, &Breakaway::torque_after);
    const Sides after_noise = noise(after, 1);
    tests.by_transducers.intercept(draw) = half_difference(drawn_after) - half_difference(after);
    tests.by_transducers.offset(draw) = half_sum(drawn_after) - half_sum(after);
    tests.by_scatter.intercept(draw) = half_difference(after_noise);
    tests.by_scatter.offset(draw) = half_sum(after_noise);
    breakaway(draw) =
        scale_error * (half_difference(drawn_start) + half_difference(noise(start, 0)));
    coulomb(draw) = scale_error * (half_difference(drawn_after) + half_difference(after_noise));
    offset(draw) = scale_error * (half_sum(drawn_after) + half_sum(after_noise));
  }
  measure(exact);
  tests.breakaway = numerics::interval_from_samples(half_difference(start), breakaway);
  tests.coulomb = numerics::interval_from_samples(half_difference(after), coulomb);
  tests.offset = numerics::interval_from_samples(half_sum(after), offset);
  tests.notes.push_back(fmt::format(
      "Slow ramp: {} starts from rest up and {} down; {:.4g} N m as motion begins, {:.4g} N m in "
      "the {:.2g} s after; up {:.4g}, down {:.4g}, offset {:.4g} N m.",
      starts(1), starts(-1), tests.breakaway.value, tests.coulomb.value, options.after_breakaway,
      after.up, after.down, tests.offset.value));
  return tests;
}

}  // namespace boresight::identification
