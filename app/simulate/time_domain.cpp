#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/app/io/friction_leeway.hpp>
#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/drive_reach.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// All but the result.
TimeDomainSection plan(const Case& antenna, const design::TrackingProblem& problem,
                       std::string_view description, std::uint64_t seed, unsigned threads) {
  TimeDomainSection section;
  section.law = description;
  section.wind_speed = problem.wind.mean_speed;
  section.stroke_assumption = demand_assumption(antenna);
  section.friction_doubt = loose_stribeck_text(antenna.friction_curve);
  // Rounding to steps q errs by q/sqrt(12) rms.
  section.encoder_resolution = std::sqrt(12.0) * antenna.sensors.encoder_noise.value;
  auto& options = section.options;
  options.seeds = {seed};
  options.tracking_rate = antenna.drive.tracking_rate.value;
  options.slew_distance = 1.0 * degree;
  options.limits = {antenna.drive.slew_rate.value, 0.2 * degree};
  options.settled_error = tightest_budget(antenna);
  options.threads = threads;
  return section;
}

// Whether the supply holds that rate (rad/s of motor) with a valve of twice the stroke.
bool held_with_more_stroke(plant::NonlinearAntenna model, double rate) {
  model.valve.stroke_limit *= 2.0;
  return design::attainable_rate(model, rate) >= rate;
}

void simulate(const Case& antenna, const design::TrackingProblem& problem,
              const control::ControlLaw& law, TimeDomainSection& section) {
  auto loop = design::make_simulated_loop(problem, make_nonlinear_antenna(antenna), law);
  section.sample_time = loop.sample_time;
  loop.encoder_resolution = section.encoder_resolution * problem.gear_ratio;
  section.result = design::verify_in_time(problem, loop, section.options);
  const auto& slew = section.result.slew;
  const double asked = section.options.limits.rate;
  section.slew_hangs_on_stroke = slew && slew->limits.rate < asked &&
                                 !section.stroke_assumption.empty() &&
                                 held_with_more_stroke(loop.antenna, asked * problem.gear_ratio);
}

}  // namespace

std::size_t best_in_time(const std::vector<TimeDomainSection::Candidate>& candidates,
                         double error) {
  const auto still = [&](const TimeDomainSection::Candidate& one) {
    return std::isfinite(one.result.wind.beam_rms) &&
           design::holds_still(one.result.hunting, error);
  };
  const bool some_still = std::ranges::any_of(candidates, still);
  const auto rms = [&](const TimeDomainSection::Candidate& one) {
    const double value = one.result.wind.beam_rms;
    return (some_still && !still(one)) || std::isnan(value) ? HUGE_VAL : value;
  };
  const double least = rms(*std::ranges::min_element(candidates, {}, rms));
  std::size_t best = 0;
  double least_hunting = HUGE_VAL;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!(rms(candidates[i]) <= (1.0 + negligible_change) * least)) continue;
    const double hunting = design::hunting_amplitude(candidates[i].result.hunting);
    if (hunting < least_hunting * (1.0 - negligible_change)) {
      least_hunting = hunting;
      best = i;
    }
  }
  return best;
}

std::optional<TimeDomainSection> verify_in_time_domain(const Case& antenna,
                                                       const design::TrackingProblem& problem,
                                                       const control::ControlLaw& law,
                                                       std::string_view description,
                                                       std::uint64_t seed, unsigned threads) {
  if (!antenna.simulation) return std::nullopt;
  TimeDomainSection section = plan(antenna, problem, description, seed, threads);
  simulate(antenna, problem, law, section);
  return section;
}

std::optional<TimeDomainSection> choose_in_time_domain(const Case& antenna,
                                                       const design::TrackingProblem& problem,
                                                       const std::vector<DescribedLaw>& laws,
                                                       std::uint64_t seed, unsigned threads) {
  if (laws.empty()) throw InvalidInput("choose_in_time_domain: expected laws, found none");
  if (!antenna.simulation) return std::nullopt;
  std::vector<TimeDomainSection::Candidate> candidates;
  for (const auto& [description, law] : laws) {
    TimeDomainSection section = plan(antenna, problem, description, seed, threads);
    section.options.explain = false;
    simulate(antenna, problem, law, section);
    candidates.push_back({description, std::move(section.result)});
  }
  const std::size_t best = best_in_time(candidates, tightest_budget(antenna));
  auto chosen = verify_in_time_domain(antenna, problem, laws[best].law, laws[best].description,
                                      seed, threads);
  if (chosen && candidates.size() > 1) chosen->candidates = std::move(candidates);
  return chosen;
}

design::NonlinearVerificationOptions comparison_options(const Case& antenna, std::uint64_t seed) {
  auto options = plan(antenna, make_problem(antenna), "", seed, 1).options;
  options.explain = false;
  options.slew_distance = 0.0;
  return options;
}

std::optional<design::NonlinearVerification> run_in_time_domain(
    const Case& antenna, const design::TrackingProblem& problem, const control::ControlLaw& law,
    const design::NonlinearVerificationOptions& options) {
  if (!antenna.simulation) return std::nullopt;
  TimeDomainSection section = plan(antenna, problem, "", options.seeds.front(), options.threads);
  section.options = options;
  simulate(antenna, problem, law, section);
  return std::move(section.result);
}

}  // namespace boresight::app
