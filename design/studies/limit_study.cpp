#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/studies/limit_study.hpp>

namespace boresight::design {

PointingLimit pointing_limit_of(const Mission& mission, const TuningStudy& section,
                                const PlantEnsemble& ensemble, double wind_speed,
                                unsigned threads) {
  TrackingProblem problem = tracking_problem(mission);
  problem.wind.mean_speed = wind_speed;
  std::vector<NamedLaw> laws;
  for (const TunedLaw& row : section.laws) {
    if (row.wind_speed != wind_speed || !row.stable()) continue;
    laws.push_back(
        {fmt::format("{}, {}", row.structure, to_string(row.tuned_for)), row.design.tuning.law});
  }
  PointingLimitOptions options;
  options.sample_time = control::sample_time_of(problem.delay);
  options.threads = threads;
  return pointing_limit(problem, section.goals, ensemble.members, laws, options);
}

}  // namespace boresight::design
