#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/studies/commission_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

constexpr double step_fraction = 0.2;
constexpr double move_fraction = 0.05;
constexpr double move_ramp = 2.0;  // s
constexpr double largest_angle_step = 100.0 * millidegree;

// 1, 2 or 5 times a power of ten, no larger.
double round_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= value * (1.0 + 1e-12)) return step * decade;
  }
  return decade;
}

double step_of(const plant::Antenna& antenna, const CommissioningStage& stage) {
  const double by_valve =
      step_fraction * plant::largest_demand(antenna) / stage.expected.largest_demand.largest;
  const double by_torque =
      step_fraction * plant::supply_torque(antenna) / stage.expected.largest_torque.largest;
  const double largest =
      stage.controller.position_open ? step_fraction * antenna.drive.slew_rate : largest_angle_step;
  const double step = std::min(
      {plant::motor_to_sky(antenna, by_valve), plant::motor_to_sky(antenna, by_torque), largest});
  return std::isfinite(step) ? millidegree * round_down(step / millidegree)
                             : std::numeric_limits<double>::quiet_NaN();
}

// The linear plant of the stages does not know friction. In still air: the wind is theirs.
std::optional<double> disallowed_limit_cycle(const Mission& mission, const TrackingProblem& problem,
                                             const control::Controller& controller,
                                             std::uint64_t seed) {
  auto options = comparison_options(mission, seed);
  options.wind_duration = 1.0;
  const auto run = run_in_time_domain(mission, problem, controller, options);
  if (!run || is_limit_cycle_free(run->limit_cycles, options.allowed_limit_cycle))
    return std::nullopt;
  return limit_cycle_runs_complete(run->limit_cycles) ? limit_cycle_amplitude(run->limit_cycles)
                                                      : std::numeric_limits<double>::infinity();
}

void add_experiments(const Mission& mission, unsigned threads, CommissionStudy& study) {
  if (!mission.antenna.nonlinear) return;
  auto& stages = study.plan.stages;
  const FlowModel flow = flow_model(mission);
  for (auto& stage : stages) stage.flow = flow;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    study.experiments.push_back(stage_experiment(
        mission, stages[i], plant::sky_to_motor(mission.antenna, study.steps[i]), study.move));
  }
  numerics::for_each_index(stages.size(), threads, [&](std::size_t i) {
    stages[i].effects = experiment_effects(mission, stages[i], study.experiments[i]);
  });
}

// Places of the gains that act.
std::vector<std::size_t> acting_places(const StageController& stage) {
  std::vector<std::size_t> places;
  std::size_t place = 0;
  for (const auto& block : stage.controller.structure.blocks()) {
    const bool outer =
        block.path == control::LoopPath::position || block.path == control::LoopPath::compliance;
    for (std::size_t i = 0; i < block.gains.size(); ++i, ++place) {
      if (!outer || !stage.position_open) places.push_back(place);
    }
  }
  return places;
}

}  // namespace

std::vector<ActingGain> acting_gains(const StageController& stage, const StageController* before) {
  const auto acted_before = before != nullptr ? acting_places(*before) : std::vector<std::size_t>{};
  const auto same = [&](std::size_t place, std::size_t other) {
    return before->controller.structure.gains()[other].symbol ==
               stage.controller.structure.gains()[place].symbol &&
           before->controller.gains[other] == stage.controller.gains[place];
  };
  std::vector<ActingGain> gains;
  for (const std::size_t place : acting_places(stage)) {
    const bool kept =
        std::ranges::any_of(acted_before, [&](std::size_t other) { return same(place, other); });
    gains.push_back({place, before != nullptr && !kept});
  }
  return gains;
}

const TunedController* commissionable(const ControllerStudy& study) {
  const TunedController* controller = recommended_or(study, Fitness::misses_budget);
  return controller != nullptr && controller->tuned_for == TunedFor::robust &&
                 controller->constraints_met
             ? controller
             : nullptr;
}

CommandedMove commissioning_move(const Mission& mission) {
  const double rate =
      plant::sky_to_motor(mission.antenna, move_fraction * mission.antenna.drive.slew_rate);
  return {rate, rate / move_ramp};
}

CommissionStudy study_commission(const Mission& mission, const PlantEnsemble& ensemble,
                                 const control::Controller& target,
                                 const CommissioningOptions& options, std::uint64_t seed) {
  CommissionStudy study;
  study.problem = tracking_problem(mission);
  study.move = commissioning_move(mission);
  std::optional<control::Controller> found;
  if (!mission.present_controllers.empty()) found = mission.present_controllers.front().controller;
  study.plan =
      plan_commissioning(study.problem, ensemble.members, found, target, study.move, options);
  for (const auto& stage : study.plan.stages) {
    study.steps.push_back(step_of(mission.antenna, stage));
  }
  add_experiments(mission, options.threads, study);
  study.limit_cycle = disallowed_limit_cycle(mission, study.problem, target, seed);
  return study;
}

}  // namespace boresight::design
