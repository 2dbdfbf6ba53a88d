#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/design/studies/benchmark_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

// Attitudes of the protocol that the table covers: every 45 degrees of yaw at every 20 of elevation
// from 10.
std::vector<WindAttitudeCoefficient> attitudes_of(const Mission& mission) {
  std::vector<WindAttitudeCoefficient> attitudes;
  if (!mission.torque_table) return attitudes;
  for (int elevation = 10; elevation <= 90; elevation += 20) {
    for (int yaw = -135; yaw <= 180; yaw += 45) {
      try {
        attitudes.push_back({fmt::format("yaw {} deg, elevation {} deg", yaw, elevation),
                             mission.torque_table->at(yaw * degree, elevation * degree)});
      } catch (const InvalidInput&) {
        continue;  // outside the table
      }
    }
  }
  return attitudes;
}

bool is_present(const control::Controller& controller, const Mission& mission) {
  return std::ranges::any_of(mission.present_controllers, [&](const auto& present) {
    return present.controller.structure == controller.structure &&
           present.controller.gains == controller.gains;
  });
}

}  // namespace

BenchmarkedController controller_of(const control::Controller& tuned,
                                    const std::string& description, double sample_time) {
  BenchmarkedController controller;
  controller.controller = tuned;
  controller.description = description;
  const plant::StateSpace* own = tuned.structure.state_space();
  controller.system = control::antenna_state_space_controller(
      own != nullptr      ? *own
      : sample_time > 0.0 ? control::sampled_controller(tuned, sample_time)
                          : control::to_state_space(tuned));
  return controller;
}

bool BenchmarkStudy::samples_otherwise() const {
  const double sample_time = controller.system.sample_time;
  return sample_time > 0.0 &&
         std::abs(sample_time - expected_sample_time) > 1e-6 * expected_sample_time;
}

BenchmarkStudy study_rejection(const Mission& mission, const std::vector<EnsembleMember>& members,
                               const BenchmarkedController& controller,
                               const BenchmarkOptions& options) {
  const TrackingProblem problem = tracking_problem(mission);
  BenchmarkStudy study;
  study.controller = controller;
  study.present_gains = controller.controller && is_present(*controller.controller, mission);
  const double sample_time = controller.system.sample_time;
  study.dead_time = sample_time > 0.0 ? sample_time : problem.delay;
  study.expected_sample_time = control::sample_time_of(problem.delay);
  study.gear_ratio = problem.gear_ratio;
  study.wind = problem.wind;
  study.rms_band = problem.rms_band;
  study.goals = constraints(mission);
  study.budgets = mission.budgets;

  RejectionOptions scoring;
  scoring.attitudes = attitudes_of(mission);
  scoring.members = members;
  for (const auto& budget : study.budgets) scoring.budgets.push_back(budget.rms);
  scoring.sample_time = study.expected_sample_time;
  scoring.threads = options.threads;
  constexpr std::size_t parts = 5;  // four of the score, and the time domain
  std::size_t done = 0;
  scoring.stop = [&] {
    if (options.progress) options.progress(done, parts);
    ++done;
    return options.interrupted && options.interrupted();
  };
  study.attitudes = scoring.attitudes.size();
  study.score = rejection_benchmark(problem, study.goals, study.controller.system, scoring);
  study.interrupted = !study.score.left_out.empty();
  if (study.score.stable && study.score.step.horizon > 0.0) {
    constexpr double longest = 120.0;  // s
    const control::ClosedLoopResponse course(problem.plant, study.controller.system, problem.delay);
    const double shown = std::min(longest, study.score.step.horizon);
    study.step_course = course.boresight(control::DisturbanceType::step, shown);
    study.impulse_course = course.boresight(control::DisturbanceType::impulse, shown);
  }
  if (!study.score.stable) {
    study.no_nonlinear = NoTimeDomain::unstable;
  } else if (scoring.stop()) {
    study.interrupted = true;
    study.no_nonlinear = NoTimeDomain::interrupted;
  } else if (!study.controller.controller) {
    study.no_nonlinear = NoTimeDomain::state_space;
  } else if (!mission.antenna.nonlinear) {
    study.no_nonlinear = NoTimeDomain::linear_only;
  } else {
    study.nonlinear = verify_in_time_domain(mission, problem, *study.controller.controller,
                                            study.controller.description, options.seed,
                                            options.threads, FurtherRuns::none);
    study.simulated_budget_speeds = budget_speeds(problem, *study.controller.controller,
                                                  study.budgets, study.nonlinear->own().effect());
  }
  return study;
}

}  // namespace boresight::design
