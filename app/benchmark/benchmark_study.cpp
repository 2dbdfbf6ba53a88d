#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/control/controllers/sampled_law.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// Attitudes of the protocol that the table covers: every 45 degrees of yaw at every 20 of elevation
// from 10.
std::vector<design::WindAttitudeCoefficient> attitudes_of(const design::Mission& mission) {
  std::vector<design::WindAttitudeCoefficient> attitudes;
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

bool is_present(const control::ControlLaw& law, const design::Mission& mission) {
  return std::ranges::any_of(mission.present_controllers, [&](const auto& present) {
    return present.law.structure == law.structure && present.law.gains == law.gains;
  });
}

}  // namespace

BenchmarkedController controller_of(const control::ControlLaw& law, const std::string& description,
                                    double sample_time) {
  BenchmarkedController controller;
  controller.law = law;
  controller.description = description;
  controller.system = control::antenna_state_space_controller(
      sample_time > 0.0 ? control::sampled_law(law, sample_time) : control::to_state_space(law));
  return controller;
}

BenchmarkReport benchmark(const io::DesignedAntenna& designed,
                          const BenchmarkedController& controller,
                          const BenchmarkOptions& options) {
  const io::Case& antenna = designed.antenna;
  const design::Mission& mission = designed.mission;
  const design::TrackingProblem problem = tracking_problem(mission);
  BenchmarkReport report;
  report.case_path = antenna.path;
  report.title = antenna.title;
  report.axis = antenna.axis;
  report.seed = options.seed;
  report.controller = controller;
  report.present_gains = controller.law && is_present(*controller.law, mission);
  const double sample_time = controller.system.sample_time;
  report.dead_time = sample_time > 0.0 ? sample_time : problem.delay;
  report.gear_ratio = problem.gear_ratio;
  report.wind = problem.wind;
  report.rms_band = problem.rms_band;
  report.goals = constraints(mission);
  report.budgets = mission.budgets;
  report.from_records = designed.from_records;
  report.ensemble_source = to_string(designed.ensemble.source);
  const double expected = control::sample_time_of(problem.delay);
  if (sample_time > 0.0 && std::abs(sample_time - expected) > 1e-6 * expected) {
    report.controller.remarks.push_back(
        fmt::format("warning: the controller samples every {:g} s, the case's delay of {:g} s "
                    "speaks of {:g} s (one and a half samples); the controller's own is used, with "
                    "one sample of computation",
                    sample_time, problem.delay, expected));
  }

  design::RejectionOptions scoring;
  scoring.attitudes = attitudes_of(mission);
  scoring.members = designed.ensemble.members;
  for (const auto& budget : report.budgets) scoring.budgets.push_back(budget.rms);
  scoring.sample_time = expected;
  scoring.threads = options.threads;
  constexpr std::size_t parts = 5;  // four of the score, and the time domain
  std::size_t done = 0;
  scoring.stop = [&] {
    if (options.progress) options.progress(done, parts);
    ++done;
    return options.interrupted && options.interrupted();
  };
  report.attitudes =
      scoring.attitudes.empty()
          ? fmt::format(
                "one torque coefficient of {:g} for every attitude: the case has no table "
                "over yaw and elevation",
                antenna.wind.torque_coefficient.value)
          : fmt::format(
                "{} attitudes of the case's table of torque coefficients, and the case's "
                "own",
                scoring.attitudes.size());
  report.score =
      design::rejection_benchmark(problem, report.goals, report.controller.system, scoring);
  report.interrupted = !report.score.left_out.empty();
  if (report.score.stable && report.score.step.horizon > 0.0) {
    constexpr double longest = 120.0;  // s
    const control::ControlledCourse course(problem.plant, report.controller.system, problem.delay);
    const double shown = std::min(longest, report.score.step.horizon);
    report.step_course = course.beam(control::TorqueCourse::step, shown);
    report.impulse_course = course.beam(control::TorqueCourse::impulse, shown);
  }
  if (!report.score.stable) {
    report.no_time_domain = "the linear loop is unstable";
  } else if (scoring.stop()) {
    report.interrupted = true;
    report.no_time_domain = "interrupted";
  } else if (!report.controller.law) {
    report.no_time_domain =
        "run for laws of Boresight's structures only: a given state space has no stated limits and "
        "anti-windup";
  } else if (!antenna.simulation) {
    report.no_time_domain = "the case has no [simulation]";
  } else {
    report.time_domain =
        section_of(antenna, verify_in_time_domain(mission, problem, *report.controller.law,
                                                  report.controller.description, options.seed,
                                                  options.threads, design::SecondIntegrator::none));
  }
  report.assumed = assumed_inputs(antenna, {.time_runs = report.time_domain.has_value()});
  return report;
}

}  // namespace boresight::app
