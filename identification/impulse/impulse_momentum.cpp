#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/impulse/impulse_momentum.hpp>
#include <boresight/identification/impulse/impulse_samples.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

void check(const Campaign& campaign, const ImpulseMomentumOptions& options) {
  if (campaign.records.empty()) {
    throw InvalidInput("impulse_momentum: expected a campaign with records, found none");
  }
  const auto motors = campaign.records.front().inlet_pressure.size();
  for (const auto& record : campaign.records) {
    if (motors == 0 || record.inlet_pressure.size() != motors ||
        record.outlet_pressure.size() != motors) {
      throw InvalidInput(fmt::format(
          "impulse_momentum: expected inlet and outlet pressures of the same {} motors "
          "in every record, found {} and {} in '{}'",
          motors, record.inlet_pressure.size(), record.outlet_pressure.size(), record.name));
    }
  }
  if (options.random_samples < 20 || !(options.shortening >= 0.0) || !(options.shortening < 0.2)) {
    throw InvalidInput(fmt::format(
        "impulse_momentum: expected at least 20 samples and a shortening from 0 to below "
        "0.2, found {} and {}",
        options.random_samples, options.shortening));
  }
}

// The drawings' inertia, wide enough to be no more than a start.
numerics::Uncertain starting_inertia(const DriveKnowledge& knowledge) {
  const double sum = knowledge.motor_count * knowledge.motor_inertia.value +
                     knowledge.gear_inertia.value + knowledge.antenna_inertia.value;
  return {sum, 0.3 * sum};
}

struct Procedure {
  WindowRule rule;
  FrictionTreatment treatment;
  const char* name;
};

constexpr std::array<Procedure, 7> procedures{{
    {WindowRule::two_on_the_ramp, FrictionTreatment::constant_speed_line,
     "two windows, straight line of the constant-speed tests"},
    {WindowRule::two_on_the_ramp, FrictionTreatment::slow_ramp_line,
     "two windows, Coulomb friction of the slow ramp"},
    {WindowRule::two_on_the_ramp, FrictionTreatment::curve, "two windows, friction curve"},
    {WindowRule::every_speed_change, FrictionTreatment::constant_speed_line,
     "every speed change, straight line of the constant-speed tests"},
    {WindowRule::every_speed_change, FrictionTreatment::slow_ramp_line,
     "every speed change, Coulomb friction of the slow ramp"},
    {WindowRule::every_speed_change, FrictionTreatment::curve,
     "every speed change, friction curve"},
    {WindowRule::same_path, FrictionTreatment::cancelled,
     "accelerating and decelerating over the same speeds, friction cancelled"},
}};

std::vector<ImpulseWindow> windows_of(WindowRule rule, const Campaign& campaign,
                                      const std::vector<ImpulseWindow>& every) {
  if (rule != WindowRule::two_on_the_ramp) return every;
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    if (campaign.records[index].test != TestKind::fast_ramp) continue;
    auto two = ramp_windows(campaign, index);
    if (!two.empty()) return two;
  }
  return {};
}

void explain(const ImpulseMomentum& result, ImpulseEstimate& estimate) {
  if (!result.best) return;
  const double best = result.estimates[*result.best].inertia.value;
  const double away = 100.0 * (estimate.inertia.value / best - 1.0);
  if (estimate.rule == WindowRule::two_on_the_ramp) {
    const auto* with_curve = result.find(WindowRule::two_on_the_ramp, FrictionTreatment::curve);
    if (with_curve == nullptr) return;
    const double rest = 100.0 * (with_curve->inertia.value / best - 1.0);
    estimate.note =
        estimate.treatment == FrictionTreatment::curve
            ? fmt::format(
                  "{:+.1f} % against whole records: what two windows with sharp ends leave "
                  "- the structure's swing at the ends and, where the second window runs "
                  "through rest, friction that follows the contacts' springs there.",
                  rest)
            : fmt::format(
                  "{:+.1f} % against whole records: {:+.1f} % by the straight-line "
                  "friction (against the curve in the same windows), {:+.1f} % by the two "
                  "windows' sharp ends, the flexible structure and the passage through "
                  "rest.",
                  away, away - rest, rest);
    return;
  }
  if (estimate.friction_model_error) {
    estimate.note = fmt::format(
        "{:+.1f} % against whole records; {:+.1f} % by its friction, against the curve in the same "
        "windows.",
        away, 100.0 * *estimate.friction_model_error / best);
    return;
  }
  estimate.note = fmt::format("{:+.1f} % against whole records.", away);
}

template <typename Result, typename Function>
std::optional<Result> attempt(const Function& function, std::vector<std::string>& notes) {
  try {
    Result result = function();
    notes.insert(notes.end(), result.notes.begin(), result.notes.end());
    return result;
  } catch (const NumericalFailure& failure) {
    notes.emplace_back(failure.what());
    return std::nullopt;
  }
}

}  // namespace

const ImpulseEstimate* ImpulseMomentum::find(WindowRule rule, FrictionTreatment treatment) const {
  for (const auto& estimate : estimates) {
    if (estimate.rule == rule && estimate.treatment == treatment) return &estimate;
  }
  return nullptr;
}

ImpulseMomentum impulse_momentum(const Campaign& campaign, const ImpulseMomentumOptions& options) {
  check(campaign, options);
  ImpulseMomentum result;
  const numerics::Uncertain start = starting_inertia(campaign.knowledge);
  result.friction = attempt<FrictionCurveFit>(
      [&] { return fit_friction_curve(campaign, start, options.curve); }, result.notes);
  FrictionTestOptions tests = options.tests;
  tests.random_samples = options.random_samples;
  tests.seed = options.seed;
  const numerics::Uncertain inertia =
      result.friction ? numerics::Uncertain{result.friction->inertia,
                                            std::sqrt(result.friction->covariance(8, 8))}
                      : start;
  result.constant_speed = attempt<ConstantSpeedTests>(
      [&] { return constant_speed_tests(campaign, inertia, tests); }, result.notes);
  result.slow_ramp =
      attempt<SlowRampTests>([&] { return slow_ramp_tests(campaign, tests); }, result.notes);
  const ImpulseSamples random_samples(campaign, options, result);
  const auto every = impulse_windows(campaign, options.windows);
  for (const auto& [rule, treatment, name] : procedures) {
    if (!random_samples.has(treatment)) continue;
    const auto windows = windows_of(rule, campaign, every);
    if (windows.empty()) {
      result.notes.push_back(fmt::format("No windows for: {}.", name));
      continue;
    }
    ImpulseEstimate estimate = random_samples.estimate(rule, treatment, windows);
    estimate.name = name;
    if (!std::isfinite(estimate.inertia.value)) {
      result.notes.push_back(fmt::format("No change of speed in the windows for: {}.", name));
      continue;
    }
    result.estimates.push_back(std::move(estimate));
  }
  if (result.friction) {
    result.estimates.push_back(random_samples.whole_records());
    result.best = result.estimates.size() - 1;
  } else {
    for (std::size_t i = 0; i < result.estimates.size(); ++i) {
      if (result.estimates[i].rule == WindowRule::same_path) result.best = i;
    }
  }
  if (result.estimates.empty()) {
    throw NumericalFailure(
        "impulse_momentum: no test changes the speed enough and shows the friction beside it; "
        "record a fast ramp below the tachometer's limit, and constant speeds");
  }
  for (auto& estimate : result.estimates) explain(result, estimate);
  return result;
}

}  // namespace boresight::identification
