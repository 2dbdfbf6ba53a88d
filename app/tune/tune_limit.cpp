#include <fmt/format.h>

#include <boresight/app/tune/tune_limit.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {

design::PointingLimit pointing_limit_of(const io::Case& antenna, const TuneSection& section,
                                        const PlantEnsemble& ensemble, double wind_speed,
                                        unsigned threads) {
  design::TrackingProblem problem = make_problem(antenna);
  problem.wind.mean_speed = wind_speed;
  std::vector<design::NamedLaw> laws;
  for (const TunedLaw& row : section.laws) {
    if (row.wind_speed != wind_speed || !row.stable()) continue;
    laws.push_back(
        {fmt::format("{}, {}", row.structure, to_string(row.tuned_for)), row.design.tuning.law});
  }
  design::PointingLimitOptions options;
  options.sample_time = io::sample_time_of(problem.delay);
  options.threads = threads;
  return design::pointing_limit(problem, section.goals, ensemble.members, laws, options);
}

}  // namespace boresight::app
