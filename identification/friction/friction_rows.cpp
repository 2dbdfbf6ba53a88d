#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/friction/friction_rows.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

bool chosen(TestKind test, const std::vector<TestKind>& tests) {
  if (!tests.empty()) return std::find(tests.begin(), tests.end(), test) != tests.end();
  return test == TestKind::constant_speed || test == TestKind::slow_ramp ||
         test == TestKind::fast_ramp || test == TestKind::valve_steps ||
         test == TestKind::valve_chirp;
}

void check(const FrictionCurveOptions& options) {
  if (!(options.window_time >= 0.0) || !(options.guard_time >= 0.0) ||
      !(options.tachometer_zero >= 0.0) || !(options.relative_scatter >= 0.0) ||
      !(options.correlation_time > 0.0)) {
    throw InvalidInput(
        "fit_friction_curve: expected window, guard, tachometer zero and scatter of at "
        "least 0 and a positive correlation time");
  }
}

constexpr double group_time = 0.05;

// Noise of a mean over one of the friction's groups of samples, as large as it shows where the
// antenna does not move fast enough for the tachometer's ripple.
double group_noise(const DriveRecord& record) {
  const double samples = std::max(1.0, std::round(group_time / record.sample_time));
  return noise_level(record.motor_rate.values) / std::sqrt(samples);
}

// Every group of samples moves one way, faster than noise: about a reversal friction follows the
// contacts' springs, not the steady curve.
bool moves(const IntegratedMotion& motion, double slowest) {
  return motion.rate.minCoeff() > slowest || motion.rate.maxCoeff() < -slowest;
}

}  // namespace

double window_time(const DriveKnowledge& knowledge, const FrictionCurveOptions& options) {
  if (options.window_time > 0.0) return options.window_time;
  if (knowledge.locked_rotor_frequencies.empty()) return 1.0;
  return 2.0 / knowledge.locked_rotor_frequencies.front().value;
}

FrictionRows friction_rows(const Campaign& campaign, const FrictionCurveOptions& options) {
  check(options);
  FrictionRows rows;
  double quietest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const auto& record : campaign.records) {
    if (!chosen(record.test, options.tests) || record.samples() < 5) continue;
    largest = std::max(largest, std::isfinite(record.motor_rate_limit)
                                    ? record.motor_rate_limit
                                    : record.motor_rate.values.cwiseAbs().maxCoeff());
    // A clipped tachometer repeats itself: the test that clips least shows the noise.
    const double noise = group_noise(record);
    if (noise > 0.0) quietest = std::min(quietest, noise);
  }
  rows.tachometer_zero = options.tachometer_zero * largest;
  rows.slowest = (std::isfinite(quietest) ? 5.0 * quietest : 0.0) + 2.0 * rows.tachometer_zero;
  const double time = window_time(campaign.knowledge, options);
  const auto [jerk_inertia, jerk_uncertainty] = structural_jerk_inertia(campaign.knowledge);
  if (jerk_inertia > 0.0) rows.structure_uncertainty = jerk_uncertainty / jerk_inertia;
  const double scale = torque_per_pressure(campaign.knowledge);
  const auto errors = no_instrument_errors(channel_count(campaign));
  std::vector<double> torque, structure, pressure;
  bool up = false, down = false;
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    const auto& record = campaign.records[index];
    if (!chosen(record.test, options.tests)) continue;
    const auto length = static_cast<Eigen::Index>(std::lround(time / record.sample_time));
    const Eigen::Index taper = length / 2;
    for (const auto& stretch : stretches(usable_samples(record, options.guard_time))) {
      for (Eigen::Index first = stretch.first; first + length <= stretch.last;
           first += std::max<Eigen::Index>(1, length / 2)) {
        auto motion = integrate_motion(record, {first, first + length, taper}, group_time);
        if (!moves(motion, rows.slowest)) continue;
        torque.push_back(torque_impulse(motion.pressure_impulse,
                                        static_cast<Eigen::Index>(record.inlet_pressure.size()),
                                        motion.duration, scale, errors) /
                         motion.duration);
        structure.push_back(jerk_inertia * motion.jerk / motion.duration);
        pressure.push_back(motion.pressure_impulse.mean() / motion.duration);
        up = up || motion.mean_rate > 0.0;
        down = down || motion.mean_rate < 0.0;
        rows.highest_rate = std::max(rows.highest_rate, motion.rate.cwiseAbs().maxCoeff());
        rows.record.push_back(index);
        rows.time.push_back(static_cast<double>(2 * first + length) / 2.0 * record.sample_time);
        rows.motion.push_back(std::move(motion));
      }
    }
  }
  if (rows.size() < 20 || !up || !down) {
    throw NumericalFailure(fmt::format(
        "fit_friction_curve: expected at least 20 windows of {:.3g} s that move, both ways, found "
        "{}{}; add constant-speed or slow-ramp tests",
        time, rows.size(), rows.size() >= 20 ? ", all one way" : ""));
  }
  rows.torque = Eigen::Map<const Eigen::VectorXd>(torque.data(), rows.size());
  rows.structure = Eigen::Map<const Eigen::VectorXd>(structure.data(), rows.size());
  rows.common_pressure = Eigen::Map<const Eigen::VectorXd>(pressure.data(), rows.size());
  rows.mean_common_pressure = rows.common_pressure.mean();
  rows.common_pressure.array() -= rows.mean_common_pressure;
  return rows;
}

}  // namespace boresight::identification
