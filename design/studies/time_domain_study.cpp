#include <algorithm>
#include <cmath>
#include <utility>

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
  options.tightest_budget = tightest_budget(mission);
  options.settled_error = options.tightest_budget;
  options.threads = threads;
  return section;
}

// Whether the supply holds that rate (rad/s of motor) with a valve of twice the stroke.
bool held_with_more_stroke(plant::NonlinearAntenna model, double rate) {
  model.valve.stroke_limit *= 2.0;
  return attainable_rate(model, rate) >= rate;
}

SimulatedLoop loop_of(const Mission& mission, const TrackingProblem& problem,
                      const control::ControlLaw& law, double encoder_resolution) {
  auto loop = make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna), law);
  loop.encoder_resolution = encoder_resolution * problem.gear_ratio;
  return loop;
}

SimulatedLoop simulate(const Mission& mission, const TrackingProblem& problem,
                       const control::ControlLaw& law, TimeDomainStudy& section) {
  auto loop = loop_of(mission, problem, law, section.encoder_resolution);
  section.sample_time = loop.sample_time;
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

// Those required in this wind.
void count_budgets(const Mission& mission, double wind_speed, Assessment& assessment) {
  for (const auto& budget : mission.budgets) {
    if (budget.wind_speed == wind_speed) count_budget(budget.rms, assessment);
  }
}

// `known`: the rms of those runs where they were made already.
TimeDomainStudy verify(const Mission& mission, const TrackingProblem& problem,
                       const control::ControlLaw& law, TimeDomainStudy section,
                       std::optional<SimulatedRms> known) {
  const SimulatedLoop loop = simulate(mission, problem, law, section);
  section.rms = known ? std::move(known) : expected_rms(problem, loop, section.options);
  return section;
}

// The error of the gains of today in the wind of the verification.
void add_present(const Mission& mission, const TrackingProblem& problem, TimeDomainStudy& section) {
  if (mission.present_controllers.empty()) return;
  const control::ControlLaw& present = mission.present_controllers.front().law;
  const SimulatedLoop loop = loop_of(mission, problem, present, section.encoder_resolution);
  section.present = {present.structure.name(), error_in_wind(problem, loop, section.options)};
}

}  // namespace

NonlinearEffect SimulatedCandidate::effect() const {
  return NonlinearEffect::of_simulation(simulated_rms(), result.wind.predicted_rms,
                                        hunting_amplitude(result.hunting));
}

std::optional<numerics::Interval> figure_change(const SimulatedCandidate& from,
                                                const SimulatedCandidate& to) {
  if (!from.rms || !to.rms) return std::nullopt;
  return relative_change({*from.rms, hunting_amplitude(from.result.hunting)},
                         {*to.rms, hunting_amplitude(to.result.hunting)});
}

LimitCycleVerdict limit_cycle_verdict(bool within_budget, bool shown) {
  if (within_budget) return LimitCycleVerdict::within_budget;
  return shown ? LimitCycleVerdict::beyond_budget : LimitCycleVerdict::not_shown;
}

Assessment assessment_of(const NamedController& controller, const NonlinearVerification& result,
                         const std::optional<SimulatedRms>& expected, double budget) {
  Assessment assessment;
  assessment.structure = controller.name;
  assessment.parts = controller.law.structure.gains().size();
  assessment.stable = assessment.verified = true;
  assessment.nominal_constraints_met = assessment.member_constraints_met = true;
  assessment.linear_rms = result.wind.predicted_rms;
  assessment.simulated_rms = expected ? expected->rms.value : result.wind.beam_rms;
  assessment.expected = expected;
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
  section = verify(mission, problem, law, std::move(section), std::nullopt);
  add_present(mission, problem, section);
  return section;
}

std::optional<TimeDomainStudy> choose_in_time_domain(const Mission& mission,
                                                     const TrackingProblem& problem,
                                                     const std::vector<NamedController>& laws,
                                                     std::uint64_t seed, unsigned threads,
                                                     ChoiceDetail detail) {
  if (laws.empty()) throw InvalidInput("choose_in_time_domain: expected laws, found none");
  if (!mission.antenna.nonlinear) return std::nullopt;
  std::vector<TimeDomainStudy> sections;
  std::vector<Assessment> assessments;
  for (const auto& one : laws) {
    TimeDomainStudy section = plan(mission, problem, one.name, seed, threads);
    section.options.explain = false;
    sections.push_back(verify(mission, problem, one.law, std::move(section), std::nullopt));
    const TimeDomainStudy& seen = sections.back();
    assessments.push_back(assessment_of(one, seen.result, seen.rms, tightest_budget(mission)));
    count_budgets(mission, problem.wind.mean_speed, assessments.back());
  }
  // What is shown of none that is fit is shown of the least unfit.
  const std::size_t best =
      recommend(assessments, {.accepted = Fitness::unstable}).winner.value_or(0);
  TimeDomainStudy chosen = sections[best];
  if (detail == ChoiceDetail::verified) {
    TimeDomainStudy whole = plan(mission, problem, laws[best].name, seed, threads);
    whole.options.second_integrator = true;
    chosen = verify(mission, problem, laws[best].law, std::move(whole), chosen.rms);
    add_present(mission, problem, chosen);
  }
  if (sections.size() == 1) return chosen;
  for (auto& one : sections) {
    chosen.candidates.push_back({one.law, std::move(one.result), std::move(one.rms)});
  }
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

std::optional<TimeDomainStudy::Candidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const NamedController& controller,
    const NonlinearVerificationOptions& options) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section =
      plan(mission, problem, controller.name, options.seeds.front(), options.threads);
  section.options = options;
  section = verify(mission, problem, controller.law, std::move(section), std::nullopt);
  return TimeDomainStudy::Candidate{controller.name, std::move(section.result),
                                    std::move(section.rms)};
}

NonlinearEffect simulated_effect(const Mission& mission, const control::ControlLaw& law,
                                 std::uint64_t seed, unsigned threads) {
  if (!mission.antenna.nonlinear) return {};
  const auto problem = tracking_problem(mission);
  TimeDomainStudy section = plan(mission, problem, "", seed, threads);
  section.options.explain = false;
  section.options.slew_distance = 0.0;
  return verify(mission, problem, law, std::move(section), std::nullopt).own().effect();
}

}  // namespace boresight::design
