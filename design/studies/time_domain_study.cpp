#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

// All but the result.
TimeDomainStudy plan(const Mission& mission, const TrackingProblem& problem,
                     std::string_view description, std::uint64_t seed, unsigned threads) {
  TimeDomainStudy section;
  section.controller = description;
  section.wind_speed = problem.wind.mean_speed;
  section.encoder_resolution = encoder_step(mission.antenna);
  auto& options = section.options;
  options.seeds = {seed};
  options.tracking_rate = mission.antenna.drive.tracking_rate;
  options.slew_distance = 1.0 * degree;
  options.limits = {mission.antenna.drive.slew_rate, slew_acceleration};
  options.allowed_limit_cycle = allowed_limit_cycle(mission);
  options.settled_error = tightest_budget(mission);
  options.threads = threads;
  options.winds = std::make_shared<SharedWinds>();
  return section;
}

// Whether the supply holds that rate (rad/s of motor) with a valve of twice the stroke.
bool held_with_more_stroke(plant::NonlinearAntenna model, double rate) {
  model.valve.stroke_limit *= 2.0;
  return attainable_rate(model, rate) >= rate;
}

SimulatedLoop loop_of(const Mission& mission, const TrackingProblem& problem,
                      const control::Controller& controller, double encoder_resolution) {
  auto loop = make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna), controller);
  loop.encoder_resolution = encoder_resolution * problem.gear_ratio;
  return loop;
}

SimulatedLoop simulate(const Mission& mission, const TrackingProblem& problem,
                       const control::Controller& controller, TimeDomainStudy& section) {
  auto loop = loop_of(mission, problem, controller, section.encoder_resolution);
  section.sample_time = loop.sample_time;
  section.feedforward = feedforward_of(loop);
  section.friction_feedforward = loop.friction_feedforward;
  section.result = verify_in_time(problem, loop, section.options);
  const auto& slew = section.result.slew;
  const double asked = section.options.limits.rate;
  section.slew_hangs_on_stroke = slew && slew->limits.rate < asked &&
                                 held_with_more_stroke(loop.antenna, asked * problem.gear_ratio);
  return loop;
}

// `known`: mean squares of the first records, the first of which is that of the verification.
SimulatedRms expected_rms(const TrackingProblem& problem, const SimulatedLoop& loop,
                          const NonlinearVerificationOptions& options, int records,
                          Eigen::VectorXd known) {
  return simulated_rms(problem, loop,
                       {.records = records,
                        .settling = options.settling,
                        .duration = options.wind_duration,
                        .tracking_rate = options.tracking_rate,
                        .seed = options.seeds.front(),
                        .known = std::move(known),
                        .threads = options.threads,
                        .shared = options.winds});
}

// Those required in this wind.
void count_budgets(const Mission& mission, double wind_speed, Assessment& assessment) {
  for (const auto& budget : mission.budgets) {
    if (budget.wind_speed == wind_speed) count_budget(budget.rms, assessment);
  }
}

TimeDomainStudy verify(const Mission& mission, const TrackingProblem& problem,
                       const control::Controller& controller, TimeDomainStudy section,
                       int records = SimulatedRmsOptions{}.records) {
  const SimulatedLoop loop = simulate(mission, problem, controller, section);
  const WindResult& wind = section.result.wind;
  Eigen::VectorXd known;
  if (wind.status == RunStatus::complete && section.options.seeds.size() == 1) {
    known = Eigen::VectorXd::Constant(1, wind.boresight_rms * wind.boresight_rms);
  }
  section.rms = expected_rms(problem, loop, section.options, records, std::move(known));
  return section;
}

std::vector<LimitCyclesWithFriction> with_other_friction(
    const SimulatedLoop& loop, const NonlinearVerificationOptions& options) {
  return limit_cycles_by_friction(loop, friction_variations(loop.antenna.friction), options);
}

// Beyond what is compared.
void add_limit_cycles(const SimulatedLoop& loop, TimeDomainStudy& section) {
  section.limit_cycles_by_friction = with_other_friction(loop, section.options);
  section.predicted_limit_cycle = predicted_limit_cycle(
      loop, LimitCyclePrediction(loop, section.options.threads), section.options);
}

// Violations that limit cycles with the stated friction count as: above the number of runs with
// other friction, 4 variations x 2 rates x 3 starts.
constexpr int violations_of_stated_friction = 30;

// Controllers are first compared in few records of wind. Those that are tied with the best, or
// within a tenth of it, are then run in all records.
constexpr int first_records = 4;
constexpr double contending = 0.1;

// Runs it in the records that it lacks; false if there are none.
bool complete_records(const Mission& mission, const TrackingProblem& problem,
                      const control::Controller& controller, TimeDomainStudy& section) {
  const int all = SimulatedRmsOptions{}.records;
  if (!section.rms || section.rms->status != RunStatus::complete || section.rms->records >= all) {
    return false;
  }
  const auto loop = loop_of(mission, problem, controller, section.encoder_resolution);
  section.rms = expected_rms(problem, loop, section.options, all, section.rms->mean_squares);
  return true;
}

// The mission's own present controller, if it states one.
void add_own_present(const Mission& mission, const TrackingProblem& problem,
                     TimeDomainStudy& section) {
  if (mission.present_controllers.empty()) return;
  const control::Controller& present = mission.present_controllers.front().controller;
  add_present(mission, problem, {present.structure.name(), present}, false, section);
  const auto found =
      expected_rms(problem, loop_of(mission, problem, present, section.encoder_resolution),
                   section.options, SimulatedRmsOptions{}.records, {});
  if (std::isfinite(found.rms.value)) section.present->simulated_rms = found.rms.value;
}

}  // namespace

void add_present(const Mission& mission, const TrackingProblem& problem,
                 const NamedController& controller, bool retuned, TimeDomainStudy& study) {
  const SimulatedLoop loop =
      loop_of(mission, problem, controller.controller, study.encoder_resolution);
  study.present = {controller.name, error_in_wind(problem, loop, study.options), retuned};
}

NonlinearEffect SimulatedCandidate::effect() const {
  return NonlinearEffect::of_simulation(simulated_rms(), result.wind.predicted_rms,
                                        limit_cycle_amplitude(result.limit_cycles));
}

std::optional<numerics::Interval> figure_change(const SimulatedCandidate& from,
                                                const SimulatedCandidate& to) {
  if (!from.rms || !to.rms) return std::nullopt;
  return relative_change({*from.rms, limit_cycle_amplitude(from.result.limit_cycles)},
                         {*to.rms, limit_cycle_amplitude(to.result.limit_cycles)});
}

LimitCycleVerdict limit_cycle_verdict(bool allowed, bool shown) {
  if (allowed) return LimitCycleVerdict::allowed;
  return shown ? LimitCycleVerdict::not_allowed : LimitCycleVerdict::not_shown;
}

Assessment assessment_of(const NamedController& controller, const NonlinearVerification& result,
                         const std::optional<SimulatedRms>& expected, double limit_cycle) {
  Assessment assessment;
  assessment.structure = controller.name;
  assessment.parts = controller.controller.structure.parts();
  assessment.stable = assessment.verified = true;
  assessment.nominal_constraints_met = assessment.member_constraints_met = true;
  assessment.linear_rms = result.wind.predicted_rms;
  assessment.simulated_rms = expected ? expected->rms.value : result.wind.boresight_rms;
  assessment.expected = expected;
  assessment.limit_cycle_amplitude = limit_cycle_amplitude(result.limit_cycles);
  assessment.limit_cycles =
      limit_cycle_verdict(is_limit_cycle_free(result.limit_cycles, limit_cycle),
                          limit_cycle_runs_complete(result.limit_cycles));
  return assessment;
}

std::optional<TimeDomainStudy> verify_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::Controller& controller,
    std::string_view description, std::uint64_t seed, unsigned threads, FurtherRuns further) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section = plan(mission, problem, description, seed, threads);
  section.options.second_integrator = further == FurtherRuns::all;
  section = verify(mission, problem, controller, std::move(section));
  if (further == FurtherRuns::all) {
    add_limit_cycles(loop_of(mission, problem, controller, section.encoder_resolution), section);
  }
  add_own_present(mission, problem, section);
  return section;
}

TimeDomainChoice::TimeDomainChoice(const Mission& mission, TrackingProblem problem,
                                   std::uint64_t seed, unsigned threads)
    : mission_(mission),
      problem_(std::move(problem)),
      seed_(seed),
      threads_(threads),
      winds_(std::make_shared<SharedWinds>()) {}

void TimeDomainChoice::add(const NamedController& controller) {
  TimeDomainStudy section = plan(mission_, problem_, controller.name, seed_, threads_);
  section.options.explain = false;
  section.options.winds = winds_;
  sections_.push_back(
      verify(mission_, problem_, controller.controller, std::move(section), first_records));
  controllers_.push_back(controller);
}

// The place of the chosen one, which has run in all records.
std::size_t TimeDomainChoice::settle() {
  std::vector<Assessment> assessments(controllers_.size());
  const auto assess_again = [&](std::size_t i) {
    const TimeDomainStudy& seen = sections_[i];
    assessments[i] =
        assessment_of(controllers_[i], seen.result, seen.rms, allowed_limit_cycle(mission_));
    count_budgets(mission_, problem_.wind.mean_speed, assessments[i]);
  };
  for (std::size_t i = 0; i < controllers_.size(); ++i) assess_again(i);
  std::size_t best = 0;
  for (bool settled = false; !settled;) {
    // What is shown of none that is fit is shown of the least unfit.
    best = recommend(assessments, {.accepted = Fitness::unstable}).winner.value_or(0);
    const Assessment winner = assessments[best];
    settled = true;
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      if (i != best && !are_tied(assessments[i], winner, contending)) continue;
      if (!complete_records(mission_, problem_, controllers_[i].controller, sections_[i])) continue;
      assess_again(i);
      settled = false;
    }
  }
  return best;
}

TimeDomainStudy TimeDomainChoice::chosen(ChoiceDetail detail) {
  if (controllers_.empty())
    throw InvalidInput("time domain: expected controllers to choose from, found none");
  const std::size_t best = settle();
  TimeDomainStudy chosen = sections_[best];
  if (detail == ChoiceDetail::verified) {
    chosen.options.explain = chosen.options.second_integrator = true;
    const SimulatedLoop loop =
        loop_of(mission_, problem_, controllers_[best].controller, chosen.encoder_resolution);
    explain_in_wind(problem_, loop, chosen.options, chosen.result);
    add_limit_cycles(loop, chosen);
    add_own_present(mission_, problem_, chosen);
  }
  if (sections_.size() == 1) return chosen;
  for (const auto& one : sections_) chosen.candidates.push_back(one.own());
  return chosen;
}

NonlinearVerificationOptions comparison_options(const Mission& mission, std::uint64_t seed) {
  auto options = plan(mission, tracking_problem(mission), "", seed, 1).options;
  options.explain = false;
  options.slew_distance = 0.0;
  return options;
}

std::optional<NonlinearVerification> run_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::Controller& controller,
    const NonlinearVerificationOptions& options) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section = plan(mission, problem, "", options.seeds.front(), options.threads);
  section.options = options;
  simulate(mission, problem, controller, section);
  return std::move(section.result);
}

std::optional<SimulatedCandidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, std::string name,
    const control::Controller& controller, const NonlinearVerificationOptions& options) {
  if (!mission.antenna.nonlinear) return std::nullopt;
  TimeDomainStudy section = plan(mission, problem, name, options.seeds.front(), options.threads);
  section.options = options;
  section = verify(mission, problem, controller, std::move(section));
  return SimulatedCandidate{std::move(name), std::move(section.result), std::move(section.rms)};
}

std::optional<TimeDomainStudy::Candidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const NamedController& controller,
    const NonlinearVerificationOptions& options) {
  return compare_in_time_domain(mission, problem, controller.name, controller.controller, options);
}

int limit_cycle_violations(const Mission& mission, const TrackingProblem& problem,
                           const plant::StateSpace& controller, int enough, unsigned threads) {
  const TimeDomainStudy section = plan(mission, problem, "", 1, threads);
  const auto loop = loop_of(mission, problem,
                            control::state_space_controller(
                                "state space", control::antenna_state_space_controller(controller)),
                            section.encoder_resolution);
  const auto count = [&](const FrictionVariation& friction) {
    const auto runs = limit_cycles_by_friction(loop, {&friction, 1}, section.options);
    return std::transform_reduce(runs.begin(), runs.end(), 0, std::plus(),
                                 [](const auto& one) { return one.limit_cycles; });
  };
  if (count({"as stated", loop.antenna.friction}) > 0) {
    return std::min(violations_of_stated_friction, enough);
  }
  int violations = 0;
  for (const FrictionVariation& friction : friction_variations(loop.antenna.friction)) {
    if (violations >= enough) break;
    violations += count(friction);
  }
  return std::min(violations, enough);
}

NonlinearEffect simulated_effect(const Mission& mission, const control::Controller& controller,
                                 std::uint64_t seed, unsigned threads) {
  if (!mission.antenna.nonlinear) return {};
  const auto problem = tracking_problem(mission);
  TimeDomainStudy section = plan(mission, problem, "", seed, threads);
  section.options.explain = false;
  section.options.slew_distance = 0.0;
  return verify(mission, problem, controller, std::move(section)).own().effect();
}

}  // namespace boresight::design
