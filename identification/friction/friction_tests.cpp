#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <boresight/identification/friction/friction_tests.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

void check(const FrictionTestOptions& options) {
  if (!(options.settled_fraction > 0.0) || !(options.longest_tail > 0.0) ||
      !(options.longest_tail <= 1.0) || !(options.unsettled_tail > 0.0) ||
      !(options.unsettled_tail <= options.longest_tail) || options.random_samples < 20) {
    throw InvalidInput(fmt::format(
        "constant_speed_tests: expected a positive settled fraction, 0 < unsettled tail "
        "<= longest tail <= 1 and at least 20 samples, found {}, {}, {}, {}",
        options.settled_fraction, options.unsettled_tail, options.longest_tail,
        options.random_samples));
  }
}

// Mean change per sample, between means over a twentieth at either end: what a mean torque belongs
// to, where a least-squares slope does not.
double mean_change(const Eigen::VectorXd& series) {
  const Eigen::Index end = std::max<Eigen::Index>(1, series.size() / 20);
  return (series.tail(end).mean() - series.head(end).mean()) /
         static_cast<double>(series.size() - end);
}

bool is_settled(const Eigen::VectorXd& series, double fraction) {
  const Eigen::Index half = series.size() / 2;
  return std::abs(series.tail(half).mean() - series.head(half).mean()) <=
         fraction * std::abs(series.mean());
}

SteadyTail measure(const DriveRecord& record, std::size_t index, const Eigen::VectorXd& torque,
                   const HalfPeriod& samples) {
  SteadyTail tail;
  tail.record = index;
  tail.samples = samples;
  const Eigen::Index count = samples.last - samples.first + 1;
  const Eigen::VectorXd rate = record.motor_rate.values.segment(samples.first, count);
  const Eigen::VectorXd part = torque.segment(samples.first, count);
  tail.rate = rate.mean();
  tail.torque = part.mean();
  tail.torque_uncertainty = mean_uncertainty(part);
  tail.acceleration = mean_change(rate) / record.sample_time;
  tail.mean_pressure.resize(
      static_cast<Eigen::Index>(record.inlet_pressure.size() + record.outlet_pressure.size()));
  Eigen::Index channel = 0;
  for (const auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (const auto& signal : *side) {
      tail.mean_pressure(channel++) = signal.values.segment(samples.first, count).mean();
    }
  }
  return tail;
}

// A half period by the tachometer runs into the next reversal: back to where the rate was near its
// middle value over the second half.
HalfPeriod before_reversal(const Eigen::VectorXd& rate, const HalfPeriod& half) {
  const Eigen::Index middle = (half.first + half.last) / 2;
  const double usual =
      numerics::median(std::vector<double>(rate.begin() + middle, rate.begin() + half.last + 1));
  HalfPeriod result = half;
  while (result.last > middle && std::abs(rate(result.last) - usual) > 0.05 * std::abs(usual)) {
    --result.last;
  }
  return result;
}

// The longest settled tail of a half period, else the unsettled fraction of it. None where too few
// samples are usable.
std::optional<SteadyTail> steady_tail(const DriveRecord& record, std::size_t index,
                                      const Eigen::VectorXd& torque,
                                      const std::vector<bool>& usable, const HalfPeriod& half,
                                      const FrictionTestOptions& options) {
  // The command's own edge is smeared by the recorder's filter.
  const Eigen::Index last = half.last - std::max<Eigen::Index>(1, (half.last - half.first) / 100);
  Eigen::Index from = last;
  while (from > half.first && usable[static_cast<std::size_t>(from - 1)]) --from;
  if (!usable[static_cast<std::size_t>(last)]) return std::nullopt;
  const auto length = static_cast<double>(half.last - half.first + 1);
  const auto first_of = [&](double fraction) {
    return last - static_cast<Eigen::Index>(fraction * length) + 1;
  };
  for (double fraction = options.longest_tail; fraction >= 0.7 * options.unsettled_tail;
       fraction -= 0.1) {
    const Eigen::Index first = first_of(fraction);
    const Eigen::Index count = last - first + 1;
    if (first < from || count < 10) continue;
    if (is_settled(record.motor_rate.values.segment(first, count), options.settled_fraction) &&
        is_settled(torque.segment(first, count), options.settled_fraction)) {
      return measure(record, index, torque, {first, last, half.direction});
    }
  }
  const Eigen::Index first = std::max(from, first_of(options.unsettled_tail));
  if (last - first + 1 < 10) return std::nullopt;
  SteadyTail tail = measure(record, index, torque, {first, last, half.direction});
  tail.settled = false;
  return tail;
}

// All tails of a record in one direction: its mean.
struct Side {
  std::vector<const SteadyTail*> tails;
  double rate = 0.0;
  double acceleration = 0.0;
  double torque = 0.0;
  double uncertainty = 0.0;
};

Side side(const std::vector<SteadyTail>& tails, std::size_t record, int direction, double inertia) {
  Side result;
  for (const auto& tail : tails) {
    if (tail.record == record && tail.samples.direction == direction) {
      result.tails.push_back(&tail);
    }
  }
  const auto count = static_cast<double>(result.tails.size());
  double own = 0.0;
  for (const auto* tail : result.tails) {
    result.rate += tail->rate / count;
    result.torque += (tail->torque - inertia * tail->acceleration) / count;
    result.acceleration += tail->acceleration / count;
    own += tail->torque_uncertainty * tail->torque_uncertainty / (count * count);
  }
  // Friction differs with the tails' speeds and accelerations too: that is in their scatter.
  double between = 0.0;
  for (const auto* tail : result.tails) {
    between += std::pow(tail->torque - inertia * tail->acceleration - result.torque, 2);
  }
  if (count > 1.0) between /= count * (count - 1.0);
  result.uncertainty = std::sqrt(std::max(own, between));
  return result;
}

double side_torque(const Side& s, double inertia, Eigen::Index inlets, double scale,
                   const InstrumentErrors& errors) {
  double torque = 0.0;
  for (const auto* tail : s.tails) {
    torque += torque_impulse(tail->mean_pressure, inlets, 1.0, scale, errors) /
              static_cast<double>(s.tails.size());
  }
  return torque - inertia * s.acceleration;
}

struct Speed {
  std::size_t record = 0;
  Side up, down;
  Eigen::Index inlets = 0;
};

struct Evaluation {
  Eigen::VectorXd rate, coulomb, offset;
  double slope = 0.0, intercept = 0.0;
};

// Straight line through the points, each counted alike.
void fit_line(Evaluation& result) {
  if (result.rate.size() < 2) return;
  const double mean_rate = result.rate.mean();
  const Eigen::ArrayXd away = result.rate.array() - mean_rate;
  const double spread = away.square().sum();
  if (!(spread > 0.0)) return;
  result.slope = (away * result.coulomb.array()).sum() / spread;
  result.intercept = result.coulomb.mean() - result.slope * mean_rate;
}

Evaluation evaluate(const std::vector<Speed>& speeds, const numerics::Uncertain& inertia,
                    double scale, const InstrumentErrors& errors,
                    const numerics::NormalNumbers* normal) {
  const auto count = static_cast<Eigen::Index>(speeds.size());
  Evaluation result{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  double j = inertia.value;
  if (normal != nullptr) j += inertia.standard_uncertainty * normal->pair(0).real();
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& speed = speeds[static_cast<std::size_t>(i)];
    double up = side_torque(speed.up, j, speed.inlets, scale, errors);
    double down = side_torque(speed.down, j, speed.inlets, scale, errors);
    if (normal != nullptr) {
      const auto pair = normal->pair(static_cast<std::uint64_t>(i) + 1);
      up += speed.up.uncertainty * pair.real();
      down += speed.down.uncertainty * pair.imag();
    }
    result.rate(i) = 0.5 * (speed.up.rate - speed.down.rate) / (1.0 + errors.tachometer_scale);
    result.coulomb(i) = 0.5 * (up - down);
    result.offset(i) = 0.5 * (up + down);
  }
  fit_line(result);
  return result;
}

void describe(const Campaign& campaign, bool subtracted, ConstantSpeedTests& tests) {
  for (const auto& point : tests.points) {
    if (point.unsettled == 0) continue;
    tests.notes.push_back(fmt::format(
        "{}: {} of {} half periods had not settled when they ended; the inertia took {:.3g} N m of "
        "the half difference{}.",
        campaign.records[point.record].name, point.unsettled, point.tails, point.inertia_torque,
        subtracted ? ", which is subtracted" : ", which is left in"));
  }
  if (!tests.has_line) {
    tests.notes.emplace_back("One speed alone: no straight line of friction against speed.");
    return;
  }
  tests.notes.push_back(fmt::format(
      "Straight line through {} speeds from {:.3g} to {:.3g} rad/s: {:.4g} N m + {:.4g} N m s/rad "
      "times the rate; {}",
      tests.points.size(), tests.points.front().rate, tests.points.back().rate,
      tests.intercept.value, tests.slope.value,
      tests.points.size() == 2
          ? std::string("two speeds cannot show how far friction is from a straight line.")
          : fmt::format("a point lies up to {:.3g} N m off it.", tests.line_misfit)));
}

}  // namespace

ConstantSpeedTests constant_speed_tests(const Campaign& campaign,
                                        const numerics::Uncertain& inertia,
                                        const FrictionTestOptions& options) {
  check(options);
  ConstantSpeedTests tests;
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    const auto& record = campaign.records[index];
    if (record.test != TestKind::constant_speed || record.samples() < 20) continue;
    const Eigen::VectorXd torque = recorded_torque(record, campaign.knowledge);
    const auto usable = usable_samples(record, options.guard_time);
    const auto& wave = record.rate_command ? record.rate_command->values : record.motor_rate.values;
    for (const auto& half : half_periods(wave)) {
      auto tail = steady_tail(record, index, torque, usable,
                              record.rate_command ? half : before_reversal(wave, half), options);
      if (tail) tests.tails.push_back(std::move(*tail));
    }
  }
  const numerics::Uncertain subtracted = options.subtract_inertia ? inertia : numerics::Uncertain{};
  std::vector<Speed> speeds;
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    Speed speed{index, side(tests.tails, index, 1, subtracted.value),
                side(tests.tails, index, -1, subtracted.value),
                static_cast<Eigen::Index>(campaign.records[index].inlet_pressure.size())};
    if (!speed.up.tails.empty() && !speed.down.tails.empty()) speeds.push_back(std::move(speed));
  }
  if (speeds.empty()) {
    throw NumericalFailure(
        "constant_speed_tests: no constant-speed test has usable half periods both ways; record a "
        "bipolar square wave of the rate, below the tachometer's limit");
  }
  std::sort(speeds.begin(), speeds.end(), [](const Speed& x, const Speed& y) {
    return x.up.rate - x.down.rate < y.up.rate - y.down.rate;
  });
  const double scale = torque_per_pressure(campaign.knowledge);
  const InstrumentErrors exact = no_instrument_errors(channel_count(campaign));
  const Evaluation nominal = evaluate(speeds, subtracted, scale, exact, nullptr);
  const auto count = static_cast<Eigen::Index>(speeds.size());
  Eigen::MatrixXd coulomb(options.random_samples, count), offset(options.random_samples, count);
  Eigen::VectorXd slope(options.random_samples), intercept(options.random_samples);
  const auto record_draw = [&](const Evaluation& result, int draw, LineSamples& random_samples) {
    random_samples.intercept(draw) = result.intercept - nominal.intercept;
    random_samples.slope(draw) = result.slope - nominal.slope;
    random_samples.offset(draw) = result.offset.mean() - nominal.offset.mean();
  };
  for (auto* random_samples : {&tests.by_transducers, &tests.by_scatter}) {
    *random_samples = {Eigen::VectorXd(options.random_samples),
                       Eigen::VectorXd(options.random_samples),
                       Eigen::VectorXd(options.random_samples)};
  }
  for (int draw = 0; draw < options.random_samples; ++draw) {
    const auto number = static_cast<std::uint64_t>(draw);
    const numerics::NormalNumbers normal(options.seed + 1, number);
    InstrumentErrors errors = draw_instrument_errors(campaign, options.seed, number);
    const Evaluation result = evaluate(speeds, subtracted, scale, errors, &normal);
    coulomb.row(draw) = result.coulomb;
    offset.row(draw) = result.offset;
    slope(draw) = result.slope;
    intercept(draw) = result.intercept;
    errors.torque_scale = 0.0;
    errors.tachometer_scale = 0.0;
    record_draw(evaluate(speeds, subtracted, scale, errors, nullptr), draw, tests.by_transducers);
    record_draw(evaluate(speeds, subtracted, scale, exact, &normal), draw, tests.by_scatter);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& speed = speeds[static_cast<std::size_t>(i)];
    ConstantSpeedPoint point;
    point.record = speed.record;
    point.rate = nominal.rate(i);
    point.coulomb = numerics::interval_from_samples(nominal.coulomb(i), coulomb.col(i));
    point.offset = numerics::interval_from_samples(nominal.offset(i), offset.col(i));
    point.inertia_torque = 0.5 * inertia.value * (speed.up.acceleration - speed.down.acceleration);
    for (const auto& tail : tests.tails) {
      if (tail.record != speed.record) continue;
      ++point.tails;
      if (!tail.settled) ++point.unsettled;
    }
    tests.points.push_back(point);
  }
  tests.offset = numerics::interval_from_samples(nominal.offset.mean(), offset.rowwise().mean());
  tests.has_line = count > 1;
  if (tests.has_line) {
    tests.slope = numerics::interval_from_samples(nominal.slope, slope);
    tests.intercept = numerics::interval_from_samples(nominal.intercept, intercept);
    tests.line_misfit =
        (nominal.coulomb.array() - nominal.intercept - nominal.slope * nominal.rate.array())
            .abs()
            .maxCoeff();
  }
  describe(campaign, options.subtract_inertia, tests);
  return tests;
}

}  // namespace boresight::identification
