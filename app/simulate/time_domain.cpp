#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

std::optional<TimeDomainSection> verify_in_time_domain(const Case& antenna,
                                                       const design::TrackingProblem& problem,
                                                       const control::ControlLaw& law,
                                                       std::string_view description,
                                                       std::uint64_t seed, unsigned threads) {
  if (!antenna.simulation) return std::nullopt;
  auto loop = design::make_simulated_loop(problem, make_nonlinear_antenna(antenna), law);
  TimeDomainSection section;
  section.law = description;
  section.wind_speed = problem.wind.mean_speed;
  section.sample_time = loop.sample_time;
  // Rounding to steps q errs by q/sqrt(12) rms.
  section.encoder_resolution = std::sqrt(12.0) * antenna.sensors.encoder_noise.value;
  loop.encoder_resolution = section.encoder_resolution * problem.gear_ratio;
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
  section.result = design::verify_in_time(problem, loop, options);
  return section;
}

}  // namespace boresight::app
