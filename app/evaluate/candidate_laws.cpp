#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/evaluate/candidate_laws.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::app {
namespace {

using design::TuningStatus;

constexpr double infinity = std::numeric_limits<double>::infinity();
// As many as the reference ensemble has.
constexpr std::size_t drawn_members = 30;

// Of the antenna as it is those of designed_antenna.
std::vector<design::EnsembleMember> members_of(const io::Case& as_is, const io::Case& proposed,
                                               const PlantUncertainty& uncertainty,
                                               std::uint64_t seed) {
  if (!uncertainty.from_records) return plant_members(mission_of(proposed), seed);
  std::vector<design::EnsembleMember> members;
  for (std::size_t i = 0; i < drawn_members; ++i) {
    members.push_back({fmt::format("draw {}", i + 1),
                       proposed_plant(as_is, proposed, uncertainty.distribution.draw(seed, i))});
  }
  return members;
}

double over_members(const design::EnsembleResult& ensemble) {
  double sum = 0.0;
  for (const auto& member : ensemble.members) {
    if (!member.stable) return infinity;
    sum += member.beam_rms * member.beam_rms;
  }
  return std::sqrt(sum / static_cast<double>(ensemble.members.size()));
}

// Where none is fit the least unfit; of those that miss their goals the nearest to them; null
// without a stable one.
const TunedLaw* standing_for(const design::ControllerStudy& study) {
  if (const TunedLaw* law = recommended_or(study, design::Fitness::lost_in_wind)) return law;
  const TunedLaw* nearest = nullptr;
  for (const auto& row : study.tuned.laws) {
    if (row.tuned_for != TunedFor::robust || !row.stable()) continue;
    if (nearest == nullptr ||
        row.design.tuning.worst_goal_ratio < nearest->design.tuning.worst_goal_ratio) {
      nearest = &row;
    }
  }
  return nearest;
}

CandidateLaw candidate_law(const io::Case& antenna, const design::ControllerStudy& study,
                           const TunedLaw& row, const std::vector<design::EnsembleMember>& members,
                           const EvaluateOptions& options) {
  CandidateLaw law;
  law.structure = row.structure;
  law.design = row.design;
  law.member_rms = infinity;
  if (!law.stable() || !row.ensemble) return law;
  const design::EnsembleResult& ensemble = *row.ensemble;
  law.gains = io::GainUnits(antenna).texts(law.design.tuning.law);
  law.ensemble = ensemble;
  law.member_rms = over_members(ensemble);
  law.goals_met = law.design.tuning.status == TuningStatus::optimal &&
                  ensemble.within_goals == static_cast<int>(members.size());
  auto problem = make_problem(antenna);
  problem.wind.mean_speed = row.wind_speed;
  const auto& gains = law.design.tuning.law;
  if (options.time_domain) {
    const design::Mission mission = mission_of(antenna);
    const auto how = comparison_options(mission, options.seed);
    const auto* run = study.time_domain ? run_of(*study.time_domain, row) : nullptr;
    law.time_domain =
        run != nullptr ? std::optional(*run) : run_in_time_domain(mission, problem, gains, how);
    law.still =
        !law.time_domain || design::holds_still(law.time_domain->hunting, how.settled_error);
  }
  law.budgets_met = plants_within_budgets(problem, members, gains, study.tuned.goals,
                                          make_budgets(antenna), law.nonlinear_factor(), 1);
  return law;
}

TunedCandidate tune_candidate(const io::Case& antenna, const design::PlantEnsemble& ensemble,
                              const design::TuneOptions& how, const EvaluateOptions& options) {
  const design::Mission mission = mission_of(antenna);
  const design::ControllerStudy study =
      options.time_domain
          ? study_controllers(mission, ensemble, how)
          : design::ControllerStudy{tune_structures(mission, ensemble, how), std::nullopt};
  TunedCandidate candidate;
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  candidate.whole = !stopped();
  const TunedLaw* standing = standing_for(study);
  std::vector<const TunedLaw*> rows;
  for (const auto& row : study.tuned.laws) {
    const bool alike = standing == nullptr || (row.tuned_for == standing->tuned_for &&
                                               row.wind_speed == standing->wind_speed);
    if (row.tuned_for == TunedFor::present || !alike) continue;
    if (&row == standing) candidate.chosen = rows.size();
    rows.push_back(&row);
  }
  candidate.laws.resize(rows.size());
  numerics::for_each_index(rows.size(), options.threads, [&](std::size_t i) {
    if (stopped()) return;
    candidate.laws[i] = candidate_law(antenna, study, *rows[i], ensemble.members, options);
  });
  candidate.whole = candidate.whole && !stopped();
  return candidate;
}

}  // namespace

TunedCandidates tune_candidates(const std::vector<io::Case>& cases,
                                const std::vector<std::vector<std::string>>& structures,
                                const PlantUncertainty& uncertainty, int starts,
                                const EvaluateOptions& options) {
  // Of each candidate, and of the draws that follow.
  constexpr std::size_t steps = 1000;
  TunedCandidates result;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    design::PlantEnsemble ensemble;
    ensemble.members = members_of(cases.front(), cases[i], uncertainty, options.seed);
    design::TuneOptions how;
    how.structures = structure_option(cases[i], structures[i]);
    how.starts = starts;
    how.seed = options.seed;
    how.threads = options.threads;
    how.interrupted = options.interrupted;
    if (options.progress) {
      how.progress = [&](std::size_t done, std::size_t all) {
        options.progress(steps * i + steps * done / all, steps * (cases.size() + 1));
      };
    }
    result.members = ensemble.members.size();
    result.candidates.push_back(tune_candidate(cases[i], ensemble, how, options));
  }
  return result;
}

}  // namespace boresight::app
