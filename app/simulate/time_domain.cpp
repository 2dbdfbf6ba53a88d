#include <algorithm>
#include <cmath>

#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// All but the result.
TimeDomainSection plan(const io::Case& antenna, const design::TrackingProblem& problem,
                       std::string_view description, std::uint64_t seed, unsigned threads) {
  TimeDomainSection section;
  section.law = description;
  section.wind_speed = problem.wind.mean_speed;
  section.stroke_assumption = io::demand_assumption(antenna);
  section.friction_doubt = io::loose_stribeck_text(antenna.friction_curve);
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

void simulate(const io::Case& antenna, const design::TrackingProblem& problem,
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

// Budgets required in this wind are held against the larger of both rms and the limit cycle.
void count_budgets(const io::Case& antenna, double wind_speed,
                   const design::NonlinearVerification& result, design::Assessment& assessment) {
  constexpr double round_off = 1e-6;
  const double rms = std::max(result.wind.beam_rms, result.wind.predicted_rms);
  for (const auto& budget : make_budgets(antenna)) {
    if (budget.wind_speed != wind_speed) continue;
    const double limit = (1.0 + round_off) * budget.rms;
    ++assessment.budgets_required;
    if (rms <= limit && design::holds_still(result.hunting, limit)) ++assessment.budgets_met;
  }
}

}  // namespace

design::LimitCycleVerdict limit_cycle_verdict(bool within_budget, bool shown) {
  using design::LimitCycleVerdict;
  if (within_budget) return LimitCycleVerdict::within_budget;
  return shown ? LimitCycleVerdict::beyond_budget : LimitCycleVerdict::not_shown;
}

design::Assessment assessment_of(const DescribedLaw& controller,
                                 const design::NonlinearVerification& result, double budget) {
  design::Assessment assessment;
  assessment.structure = controller.description;
  assessment.parts = controller.law.structure.gains().size();
  assessment.stable = assessment.verified = true;
  assessment.nominal_constraints_met = assessment.member_constraints_met = true;
  assessment.linear_rms = result.wind.predicted_rms;
  assessment.simulated_rms = result.wind.beam_rms;
  assessment.limit_cycle_amplitude = design::hunting_amplitude(result.hunting);
  assessment.limit_cycles = limit_cycle_verdict(design::holds_still(result.hunting, budget),
                                                design::hunting_seen(result.hunting));
  return assessment;
}

std::optional<TimeDomainSection> verify_in_time_domain(
    const io::Case& antenna, const design::TrackingProblem& problem, const control::ControlLaw& law,
    std::string_view description, std::uint64_t seed, unsigned threads, SecondIntegrator second) {
  if (!antenna.simulation) return std::nullopt;
  TimeDomainSection section = plan(antenna, problem, description, seed, threads);
  section.options.second_integrator = second == SecondIntegrator::cvodes;
  simulate(antenna, problem, law, section);
  return section;
}

std::optional<TimeDomainSection> choose_in_time_domain(const io::Case& antenna,
                                                       const design::TrackingProblem& problem,
                                                       const std::vector<DescribedLaw>& laws,
                                                       std::uint64_t seed, unsigned threads,
                                                       ChoiceDetail detail) {
  if (laws.empty()) throw InvalidInput("choose_in_time_domain: expected laws, found none");
  if (!antenna.simulation) return std::nullopt;
  std::vector<TimeDomainSection> sections;  // their results among the candidates
  std::vector<TimeDomainSection::Candidate> candidates;
  std::vector<design::Assessment> assessments;
  for (const auto& one : laws) {
    TimeDomainSection section = plan(antenna, problem, one.description, seed, threads);
    section.options.explain = false;
    simulate(antenna, problem, one.law, section);
    assessments.push_back(assessment_of(one, section.result, tightest_budget(antenna)));
    count_budgets(antenna, problem.wind.mean_speed, section.result, assessments.back());
    candidates.push_back({one.description, std::move(section.result)});
    sections.push_back(std::move(section));
  }
  // What is shown of none that is fit is shown of the least unfit.
  const std::size_t best =
      design::recommend(assessments, {.accepted = design::Fitness::unstable}).winner.value_or(0);
  if (detail == ChoiceDetail::compared) {
    TimeDomainSection chosen = std::move(sections[best]);
    chosen.result = candidates[best].result;
    if (candidates.size() > 1) chosen.candidates = std::move(candidates);
    return chosen;
  }
  auto chosen = verify_in_time_domain(antenna, problem, laws[best].law, laws[best].description,
                                      seed, threads, SecondIntegrator::cvodes);
  if (chosen && candidates.size() > 1) chosen->candidates = std::move(candidates);
  return chosen;
}

design::NonlinearVerificationOptions comparison_options(const io::Case& antenna,
                                                        std::uint64_t seed) {
  auto options = plan(antenna, make_problem(antenna), "", seed, 1).options;
  options.explain = false;
  options.slew_distance = 0.0;
  return options;
}

std::optional<design::NonlinearVerification> run_in_time_domain(
    const io::Case& antenna, const design::TrackingProblem& problem, const control::ControlLaw& law,
    const design::NonlinearVerificationOptions& options) {
  if (!antenna.simulation) return std::nullopt;
  TimeDomainSection section = plan(antenna, problem, "", options.seeds.front(), options.threads);
  section.options = options;
  simulate(antenna, problem, law, section);
  return std::move(section.result);
}

}  // namespace boresight::app
