#include <utility>
#include <vector>

#include <boresight/app/tune/controller_study.hpp>
#include <boresight/app/tune/laws_in_time.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/app/tune/tuned_assessment.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

// The usable designs for the same purpose and wind speed.
std::vector<DescribedLaw> alternatives(const TuneSection& section, const TunedLaw& best) {
  std::vector<DescribedLaw> laws;
  for (const auto& row : section.laws) {
    if (row.tuned_for != best.tuned_for || row.wind_speed != best.wind_speed || !row.usable()) {
      continue;
    }
    laws.push_back({description_of(row), row.design.tuning.law});
  }
  return laws;
}

}  // namespace

ControllerStudy study_controllers(const io::Case& antenna, const PlantEnsemble& ensemble,
                                  const TuneOptions& options, ChoiceDetail detail) {
  ControllerStudy study{tune_structures(antenna, ensemble, options), std::nullopt};
  const TunedLaw* best = best_law(study.tuned);
  if (best == nullptr || (options.interrupted && options.interrupted())) return study;
  auto problem = make_problem(antenna);
  problem.wind.mean_speed = best->wind_speed;
  study.time_domain = choose_in_time_domain(antenna, problem, alternatives(study.tuned, *best),
                                            options.seed, options.threads, detail);
  judge_in_time(antenna, study.time_domain, best->tuned_for, options.seed, options.threads,
                options.interrupted, study.tuned);
  return study;
}

const TunedLaw* recommended_or(const ControllerStudy& study, design::Fitness accepted) {
  if (const TunedLaw* law = recommended_law(study.tuned)) return law;
  // One that was not simulated beside others that limit-cycle is none to prefer.
  if (study.time_domain && accepted >= design::Fitness::lost_in_wind) {
    return shown_law(study.tuned, study.time_domain);
  }
  return recommended_at(study.tuned, study.tuned.wind_speeds.front(), true, {.accepted = accepted});
}

}  // namespace boresight::app
