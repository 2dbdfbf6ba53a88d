#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/time_domain.hpp>
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
  // Rounding to steps q errs by q/sqrt(12) rms.
  section.encoder_resolution = std::sqrt(12.0) * antenna.sensors.encoder_noise.value;
  auto& options = section.options;
  options.seeds = {seed};
  options.tracking_rate = antenna.drive.tracking_rate.value;
  options.slew_distance = 1.0 * degree;
  options.limits = {antenna.drive.slew_rate.value, 0.2 * degree};
  options.settled_error = 1e-3 * degree;
  const auto budgets = make_budgets(antenna);
  const auto tightest = std::ranges::min_element(budgets, {}, &PointingBudget::rms);
  if (tightest != budgets.end()) options.settled_error = tightest->rms;
  options.threads = threads;
  return section;
}

void simulate(const Case& antenna, const design::TrackingProblem& problem,
              const control::ControlLaw& law, TimeDomainSection& section) {
  auto loop = design::make_simulated_loop(problem, make_nonlinear_antenna(antenna), law);
  section.sample_time = loop.sample_time;
  loop.encoder_resolution = section.encoder_resolution * problem.gear_ratio;
  section.result = design::verify_in_time(problem, loop, section.options);
}

}  // namespace

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
  std::size_t best = 0;
  for (const auto& [description, law] : laws) {
    TimeDomainSection section = plan(antenna, problem, description, seed, threads);
    section.options.explain = false;
    simulate(antenna, problem, law, section);
    candidates.push_back({description, std::move(section.result)});
    // False for a NaN on the left, which an incomplete run has.
    const double least = candidates[best].result.wind.beam_rms;
    const double own = candidates.back().result.wind.beam_rms;
    if (own < least || (std::isnan(least) && !std::isnan(own))) best = candidates.size() - 1;
  }
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
