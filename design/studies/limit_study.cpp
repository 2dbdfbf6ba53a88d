#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/limit_study.hpp>
#include <boresight/design/studies/time_domain_study.hpp>

namespace boresight::design {

PointingLimit pointing_limit_of(const Mission& mission, const TuningStudy& section,
                                const PlantEnsemble& ensemble, double wind_speed,
                                unsigned threads) {
  TrackingProblem problem = tracking_problem(mission);
  problem.wind.mean_speed = wind_speed;
  std::vector<DescribedController> controllers;
  for (const TunedController& row : section.controllers) {
    if (row.wind_speed != wind_speed || !row.stable()) continue;
    controllers.push_back({fmt::format("{}, {}", row.structure, to_string(row.tuned_for)),
                           row.design.tuning.controller});
  }
  PointingLimitOptions options;
  options.sample_time = control::sample_time_of(problem.delay);
  options.threads = threads;
  if (const TunedController* recommended = recommended_tuned_controller(section, wind_speed)) {
    options.start = {description_of(*recommended), recommended->design.tuning.controller};
  }
  if (mission.antenna.nonlinear) {
    options.violations = [&](const plant::StateSpace& controller, int enough) {
      return limit_cycle_violations(mission, problem, controller, enough, threads);
    };
  }
  if (ensemble.source == EnsembleSource::ranges && !ensemble.members.empty()) {
    options.corners = corner_members(mission);
  }
  return pointing_limit(problem, section.goals, ensemble.members, controllers, options);
}

}  // namespace boresight::design
