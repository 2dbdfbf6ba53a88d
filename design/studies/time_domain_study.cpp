#include <algorithm>
#include <cmath>

#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

// All but the result.
TimeDomainStudy plan(const Mission& mission, const TrackingProblem& problem,
                     std::string_view description, std::uint64_t seed, unsigned threads) {
  TimeDomainStudy section;
  section.law = description;
  section.wind_speed = problem.wind.mean_speed;
  // Rounding to steps q errs by q/sqrt(12) rms.
  section.encoder_resolution = std::sqrt(12.0) * mission.antenna.sensors.encoder_noise;
  auto& options = section.options;
  options.seeds = {seed};
  options.tracking_rate = mission.antenna.drive.tracking_rate;
  options.slew_distance = 1.0 * degree;
  options.limits = {mission.antenna.drive.slew_rate, 0.2 * degree};
  options.settled_error = tightest_budget(mission);
  options.threads = threads;
  return section;
}

// Whether the supply holds that rate (rad/s of motor) with a valve of twice the stroke.
bool held_with_more_stroke(plant::NonlinearAntenna model, double rate) {
  model.valve.stroke_limit *= 2.0;
  return attainable_rate(model, rate) >= rate;
}

SimulatedLoop simulate(const Mission& mission, const TrackingProblem& problem,
                       const control::ControlLaw& law, TimeDomainStudy& section) {
  auto loop = make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna), law);
  section.sample_time = loop.sample_time;
  loop.encoder_resolution = section.encoder_resolution * problem.gear_ratio;
  section.result = verify_in_time(problem, loop, section.options);
  const auto& slew = section.result.slew;
  const double asked = section.options.limits.rate;
  section.slew_hangs_on_stroke = slew && slew->limits.rate < asked &&
                                 held_with_more_stroke(loop.antenna, asked * problem.gear_ratio);
  return loop;
}

SimulatedRms expected_rms(const TrackingProblem& problem, const SimulatedLoop& loop,
                          const NonlinearVerificationOptions& options) {
  return simulated_rms(problem, loop,
                       {.settling = options.settling,
                        .duration = options.wind_duration,
                        .tracking_rate = options.tracking_rate,
                        .seed = options.seeds.front(),
                        .threads = options.threads});
}

// Budgets required in this wind are held against the larger of both rms and the limit cycle.
void count_budgets(const Mission& mission, double wind_speed, const NonlinearVerification& result,
                   Assessment& assessment) {
  constexpr double round_off = 1e-6;
  const double rms = std::max(result.wind.beam_rms, result.wind.predicted_rms);
  for (const auto& budget : mission.budgets) {
    if (budget.wind_speed != wind_speed) continue;
    const double limit = (1.0 + round_off) * budget.rms;
    ++assessment.budgets_required;
    if (rms <= limit && holds_still(result.hunting, limit)) ++assessment.budgets_met;
  }
}

}  // namespace

LimitCycleVerdict limit_cycle_verdict(bool within_budget, bool shown) {
  if (within_budget) return LimitCycleVerdict::within_budget;
  return shown ? LimitCycleVerdict::beyond_budget : LimitCycleVerdict::not_shown;
}

Assessment assessment_of(const NamedController& controller, const NonlinearVerification& result,
                         double budget) {
  Assessment assessment;
  assessment.structure = controller.name;
  assessment.parts = controller.law.structure.gains().size();
  assessment.stable = assessment.verified = true;
  assessment.nominal_constraints_met = assessment.member_constraints_met = true;
  assessment.linear_rms = result.wind.predicted_rms;
  assessment.simulated_rms = result.wind.beam_rms;
  assessment.limit_cycle_amplitude = hunting_amplitude(result.hunting);
  assessment.limit_cycles =
      limit_cycle_verdict(holds_still(result.hunting, budget), hunting_seen(result.hunting));
  return assessment;
}

std::optional<TimeDomainStudy> verify_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::ControlLaw& law,
    std::string_view description, std::uint64_t seed, unsigned threads, SecondIntegrator second) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section = plan(mission, problem, description, seed, threads);
  section.options.second_integrator = second == SecondIntegrator::cvodes;
  const SimulatedLoop loop = simulate(mission, problem, law, section);
  section.rms = expected_rms(problem, loop, section.options);
  if (!mission.present_controllers.empty()) {
    const control::ControlLaw& present = mission.present_controllers.front().law;
    SimulatedLoop before = loop;
    before.law = present;
    section.present = {present.structure.name(), error_in_wind(problem, before, section.options)};
  }
  return section;
}

std::optional<TimeDomainStudy> choose_in_time_domain(const Mission& mission,
                                                     const TrackingProblem& problem,
                                                     const std::vector<NamedController>& laws,
                                                     std::uint64_t seed, unsigned threads,
                                                     ChoiceDetail detail) {
  if (laws.empty()) throw InvalidInput("choose_in_time_domain: expected laws, found none");
  if (!mission.antenna.nonlinear) return std::nullopt;
  std::vector<TimeDomainStudy> sections;  // their results among the candidates
  std::vector<TimeDomainStudy::Candidate> candidates;
  std::vector<Assessment> assessments;
  std::vector<SimulatedLoop> loops;
  for (const auto& one : laws) {
    TimeDomainStudy section = plan(mission, problem, one.name, seed, threads);
    section.options.explain = false;
    loops.push_back(simulate(mission, problem, one.law, section));
    assessments.push_back(assessment_of(one, section.result, tightest_budget(mission)));
    count_budgets(mission, problem.wind.mean_speed, section.result, assessments.back());
    candidates.push_back({one.name, std::move(section.result)});
    sections.push_back(std::move(section));
  }
  // What is shown of none that is fit is shown of the least unfit.
  const std::size_t best =
      recommend(assessments, {.accepted = Fitness::unstable}).winner.value_or(0);
  if (detail != ChoiceDetail::verified) {
    TimeDomainStudy chosen = std::move(sections[best]);
    chosen.result = candidates[best].result;
    if (detail == ChoiceDetail::expected) {
      chosen.rms = expected_rms(problem, loops[best], chosen.options);
    }
    if (candidates.size() > 1) chosen.candidates = std::move(candidates);
    return chosen;
  }
  auto chosen = verify_in_time_domain(mission, problem, laws[best].law, laws[best].name, seed,
                                      threads, SecondIntegrator::cvodes);
  if (chosen && candidates.size() > 1) chosen->candidates = std::move(candidates);
  return chosen;
}

NonlinearVerificationOptions comparison_options(const Mission& mission, std::uint64_t seed) {
  auto options = plan(mission, tracking_problem(mission), "", seed, 1).options;
  options.explain = false;
  options.slew_distance = 0.0;
  return options;
}

std::optional<NonlinearVerification> run_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::ControlLaw& law,
    const NonlinearVerificationOptions& options) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section = plan(mission, problem, "", options.seeds.front(), options.threads);
  section.options = options;
  simulate(mission, problem, law, section);
  return std::move(section.result);
}

}  // namespace boresight::design
