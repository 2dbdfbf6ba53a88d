#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <boresight/identification/impulse/impulse_samples.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {

/// Which sources of error a sample has.
struct ImpulseSamples::Sources {
  bool transducers = false;
  bool scales = false;
  bool friction = false;
  bool windows = false;
  bool structure = false;
  bool scatter = false;
};

namespace {

// Ends cut off, in shortenings: front and back.
constexpr std::array<std::pair<int, int>, 6> cuts{{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}}};

ImpulsePooling pooling_of(WindowRule rule) {
  switch (rule) {
    case WindowRule::two_on_the_ramp:
      return ImpulsePooling::mean_of_quotients;
    case WindowRule::same_path:
      return ImpulsePooling::closed_path;
    default:
      return ImpulsePooling::least_squares;
  }
}

double deviation(const Eigen::VectorXd& random_samples) {
  return std::sqrt((random_samples.array() - random_samples.mean()).square().mean());
}

}  // namespace

ImpulseSamples::ImpulseSamples(const Campaign& campaign, const ImpulseMomentumOptions& options,
                               const ImpulseMomentum& tests)
    : campaign_(&campaign),
      options_(&options),
      tests_(&tests),
      torque_per_pressure_(boresight::identification::torque_per_pressure(campaign.knowledge)),
      jerk_inertia_(structural_jerk_inertia(campaign.knowledge)) {
  // Short windows feel more of the structure than its first term: known to a third at best.
  jerk_inertia_.standard_uncertainty =
      std::max(jerk_inertia_.standard_uncertainty, jerk_inertia_.value / 3.0);
  if (tests.friction) {
    factor_ = numerics::semidefinite_factor(
        0.5 * (tests.friction->covariance + tests.friction->covariance.transpose()),
        "friction curve's covariance");
  }
  for (int draw = 0; draw < options.random_samples; ++draw) {
    errors_.push_back(
        draw_instrument_errors(campaign, options.seed, static_cast<std::uint64_t>(draw)));
  }
}

bool ImpulseSamples::has(FrictionTreatment treatment) const {
  switch (treatment) {
    case FrictionTreatment::constant_speed_line:
      return tests_->constant_speed && tests_->constant_speed->has_line;
    case FrictionTreatment::slow_ramp_line:
      return tests_->slow_ramp && tests_->constant_speed && tests_->constant_speed->has_line;
    case FrictionTreatment::curve:
      return tests_->friction.has_value();
    case FrictionTreatment::cancelled:
      return true;
  }
  return false;
}

// The nominal friction with a sample's changes by the sources that are on.
ImpulseFriction ImpulseSamples::friction(FrictionTreatment treatment, const Sources& on,
                                         int draw) const {
  ImpulseFriction result;
  if (treatment == FrictionTreatment::cancelled) return result;
  if (treatment == FrictionTreatment::curve) {
    if (!tests_->friction) return result;
    const auto& fit = *tests_->friction;
    result.curve = true;
    if (on.friction || on.transducers) {
      const auto number = static_cast<std::uint64_t>(draw);
      const InstrumentErrors exact = no_instrument_errors(fit.by_pressure_gain.cols());
      result.curve_change =
          draw_friction(fit, on.friction ? factor_ : Eigen::MatrixXd(factor_.rows(), 0),
                        on.transducers ? errors_[number] : exact, options_->seed + 3, number);
    }
    return result;
  }
  if (!tests_->constant_speed) return result;
  const auto& line = *tests_->constant_speed;
  const bool ramp = treatment == FrictionTreatment::slow_ramp_line && tests_->slow_ramp;
  result.slope = line.slope.value;
  result.intercept = ramp ? tests_->slow_ramp->coulomb.value : line.intercept.value;
  result.offset = ramp ? tests_->slow_ramp->offset.value : line.offset.value;
  const auto add = [&](const LineSamples& of_line, const LineSamples& of_level) {
    result.slope += of_line.slope(draw);
    result.intercept += of_level.intercept(draw);
    result.offset += of_level.offset(draw);
  };
  if (on.transducers) {
    add(line.by_transducers, ramp ? tests_->slow_ramp->by_transducers : line.by_transducers);
  }
  if (on.friction) add(line.by_scatter, ramp ? tests_->slow_ramp->by_scatter : line.by_scatter);
  return result;
}

// The windows as they are, and with their ends cut.
std::vector<std::vector<WindowImpulse>> ImpulseSamples::variants(
    WindowRule rule, const std::vector<ImpulseWindow>& windows) const {
  std::vector<std::vector<WindowImpulse>> result;
  for (const auto& [front, back] : cuts) {
    std::vector<WindowImpulse> set;
    if (rule == WindowRule::same_path) {
      for (int direction : {1, -1}) {
        for (const auto& source :
             common_path(*campaign_, windows, direction, front * options_->shortening,
                         back * options_->shortening)) {
          set.push_back(measure(rule, source));
        }
      }
      if (set.empty()) continue;
    } else {
      for (auto source : windows) {
        auto& cut = source.window;
        const auto step = static_cast<Eigen::Index>(
            std::lround(options_->shortening * static_cast<double>(cut.last - cut.first)));
        cut.first += front * step;
        cut.last -= back * step;
        cut.taper = std::min(cut.taper, (cut.last - cut.first) / 2);
        set.push_back(measure(rule, source));
      }
    }
    result.push_back(std::move(set));
  }
  return result;
}

WindowImpulse ImpulseSamples::measure(WindowRule rule, const ImpulseWindow& source) const {
  const auto& record = campaign_->records[source.record];
  WindowImpulse window;
  window.source = source;
  window.inlets = static_cast<Eigen::Index>(record.inlet_pressure.size());
  window.motion =
      rule == WindowRule::same_path
          ? integrate_over_speed(record, source.window, source.from_rate, source.to_rate,
                                 speed_smoothing_time(campaign_->knowledge))
          : integrate_motion(record, source.window);
  if (rule == WindowRule::every_speed_change) {
    // Disturbances' impulse grows with duration; what the structure adds beyond its first term
    // grows faster than that term.
    const double scatter = tests_->friction ? tests_->friction->scatter : 0.0;
    const double disturbance = std::max(scatter, 1e-9) * window.motion.duration;
    const double structure = jerk_inertia_.value * window.motion.jerk;
    window.weight = 1.0 / (disturbance * disturbance + structure * structure);
  }
  if (tests_->friction) add_curve(*tests_->friction, window);
  return window;
}

// Standard uncertainty of the pooled inertia from what each window leaves unexplained, at least the
// curve's scatter as a torque over all of it.
double ImpulseSamples::window_scatter(const std::vector<WindowImpulse>& windows,
                                      ImpulsePooling pooling, const ImpulseFriction& friction,
                                      double jerk_inertia, double inertia) const {
  const double scatter = tests_->friction ? tests_->friction->scatter : 0.0;
  const InstrumentErrors exact = no_instrument_errors(channel_count(*campaign_));
  double square = 0.0, total = 0.0;
  for (const auto& window : windows) {
    const double change = window.motion.rate_change;
    double left = scatter * window.motion.duration;
    double weight = 1.0 / (change * change);  // of the quotients' mean
    if (pooling == ImpulsePooling::closed_path) {
      weight = 1.0 / std::abs(change);
      left = scatter * std::abs(window.motion.duration);
    } else if (pooling == ImpulsePooling::least_squares) {
      weight = window.weight;
      left = std::max(
          left, std::abs(net_impulse(window, friction, torque_per_pressure_, jerk_inertia, exact) -
                         inertia * change));
    }
    square += std::pow(weight * change * left, 2);
    total += weight * change * change;
  }
  return total > 0.0 ? std::sqrt(square) / total : 0.0;
}

ImpulseEstimate ImpulseSamples::estimate(WindowRule rule, FrictionTreatment treatment,
                                         const std::vector<ImpulseWindow>& windows) const {
  ImpulseEstimate result;
  result.rule = rule;
  result.treatment = treatment;
  const ImpulsePooling pooling = pooling_of(rule);
  const auto sets = variants(rule, windows);
  if (sets.empty()) {
    result.inertia.value = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  const InstrumentErrors exact = no_instrument_errors(channel_count(*campaign_));
  const ImpulseFriction nominal = friction(treatment, {}, -1);
  const double value = pooled_inertia(sets.front(), nominal, pooling, torque_per_pressure_,
                                      jerk_inertia_.value, exact);
  const double scatter = window_scatter(sets.front(), pooling, nominal, jerk_inertia_.value, value);
  // What the curve would have made of the same windows: the treatment's model error.
  double left = 0.0;
  if (treatment != FrictionTreatment::curve && tests_->friction) {
    left = value - pooled_inertia(sets.front(), friction(FrictionTreatment::curve, {}, -1), pooling,
                                  torque_per_pressure_, jerk_inertia_.value, exact);
    result.friction_model_error = left;
  }
  const auto draw_all = [&](const Sources& on, int count) {
    Eigen::VectorXd random_samples(count);
    for (int draw = 0; draw < count; ++draw) {
      const auto& drawn = errors_[static_cast<std::size_t>(draw)];
      InstrumentErrors errors = exact;
      if (on.transducers) {
        errors.pressure_zero = drawn.pressure_zero;
        // With a curve the level common to all ports has been fitted.
        errors.pressure_gain =
            treatment == FrictionTreatment::curve
                ? remaining_gain_errors(drawn.pressure_gain, drawn.pressure_gain.size() / 2)
                : drawn.pressure_gain;
      }
      const numerics::NormalNumbers normal(options_->seed + 4, static_cast<std::uint64_t>(draw));
      const auto pair = normal.pair(0);
      const auto set =
          on.windows ? numerics::splitmix64(options_->seed + 5, static_cast<std::uint64_t>(draw)) %
                           sets.size()
                     : 0;
      const double jerk_inertia =
          jerk_inertia_.value +
          (on.structure ? jerk_inertia_.standard_uncertainty * pair.real() : 0.0);
      double inertia = pooled_inertia(sets[set], friction(treatment, on, draw), pooling,
                                      torque_per_pressure_, jerk_inertia, errors);
      if (on.friction) inertia += left * normal.pair(1).real();
      if (on.scatter) inertia += scatter * pair.imag();
      if (on.scales) inertia *= (1.0 + drawn.torque_scale) * (1.0 + drawn.tachometer_scale);
      random_samples(draw) = inertia;
    }
    return random_samples;
  };
  if (!std::isfinite(value)) {
    result.inertia.value = value;
    return result;
  }
  result.inertia = numerics::interval_from_samples(
      value, draw_all({true, true, true, true, true, true}, options_->random_samples));
  result.as_recorded = numerics::interval_from_samples(
      value, draw_all({false, false, true, true, true, true}, options_->random_samples));
  const int few = std::min(options_->random_samples, 100);
  const std::array<std::pair<const char*, Sources>, 6> alone{{
      {"pressure transducers", {true, false, false, false, false, false}},
      {"displacement, torque efficiency and tachometer scale",
       {false, true, false, false, false, false}},
      {"friction model", {false, false, true, false, false, false}},
      {"choice of the windows' ends", {false, false, false, true, false, false}},
      {"flexibility of the structure", {false, false, false, false, true, false}},
      {"scatter between windows", {false, false, false, false, false, true}},
  }};
  double total = 0.0;
  for (const auto& [source, on] : alone) {
    const double variance = std::pow(deviation(draw_all(on, few)), 2);
    result.fractions.push_back({source, variance});
    total += variance;
  }
  for (auto& fraction : result.fractions)
    fraction.fraction = total > 0.0 ? fraction.fraction / total : 0.0;
  std::stable_sort(
      result.fractions.begin(), result.fractions.end(),
      [](const VarianceFraction& x, const VarianceFraction& y) { return x.fraction > y.fraction; });
  for (const auto& window : sets.front()) {
    result.by_window.push_back(
        net_impulse(window, nominal, torque_per_pressure_, jerk_inertia_.value, exact) /
        window.motion.rate_change);
  }
  result.windows = sets.front();
  return result;
}

ImpulseEstimate ImpulseSamples::whole_records() const {
  ImpulseEstimate result;
  result.rule = WindowRule::whole_records;
  result.treatment = FrictionTreatment::curve;
  result.name = "friction curve and inertia fitted to whole records";
  if (!tests_->friction) return result;
  const auto& fit = *tests_->friction;
  result.as_recorded =
      numerics::normal_interval(fit.inertia, std::sqrt(std::max(0.0, fit.covariance(8, 8))));
  const InstrumentErrors exact = no_instrument_errors(fit.by_pressure_gain.cols());
  Eigen::VectorXd all(options_->random_samples), transducers(options_->random_samples),
      scales(options_->random_samples);
  for (int draw = 0; draw < options_->random_samples; ++draw) {
    const auto number = static_cast<std::uint64_t>(draw);
    const auto& errors = errors_[static_cast<std::size_t>(draw)];
    const double scale = (1.0 + errors.torque_scale) * (1.0 + errors.tachometer_scale);
    all(draw) =
        scale * (fit.inertia + draw_friction(fit, factor_, errors, options_->seed + 3, number)(8));
    transducers(draw) = fit.inertia + draw_friction(fit, Eigen::MatrixXd(factor_.rows(), 0), errors,
                                                    options_->seed + 3, number)(8);
    scales(draw) = scale * fit.inertia;
  }
  result.inertia = numerics::interval_from_samples(fit.inertia, all);
  const double by_fit = fit.covariance(8, 8), by_transducers = std::pow(deviation(transducers), 2),
               by_scales = std::pow(deviation(scales), 2);
  const double total = by_fit + by_transducers + by_scales;
  result.fractions = {{"friction model, scatter and flexibility of the structure", by_fit / total},
                      {"pressure transducers", by_transducers / total},
                      {"displacement, torque efficiency and tachometer scale", by_scales / total}};
  std::stable_sort(
      result.fractions.begin(), result.fractions.end(),
      [](const VarianceFraction& x, const VarianceFraction& y) { return x.fraction > y.fraction; });
  return result;
}

}  // namespace boresight::identification
