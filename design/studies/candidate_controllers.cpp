#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/studies/candidate_controllers.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// As many as the reference ensemble has.
constexpr std::size_t drawn_members = 30;

// Of the antenna as it is those that it is designed on everywhere else.
std::vector<EnsembleMember> members_of(const Mission& as_is, const Mission& proposed,
                                       const PlantUncertainty& uncertainty, std::uint64_t seed) {
  if (!uncertainty.from_records) return plant_members(proposed, seed);
  std::vector<EnsembleMember> members;
  for (std::size_t i = 0; i < drawn_members; ++i) {
    members.push_back(
        {fmt::format("sample {}", i + 1),
         proposed_plant(as_is.antenna, proposed.antenna, uncertainty.distribution.draw(seed, i))});
  }
  return members;
}

// Where none is fit the least unfit; of those that miss their goals the nearest to them; null
// without a stable one.
const TunedController* standing_for(const ControllerStudy& study) {
  if (const TunedController* controller = recommended_or(study, Fitness::lost_in_wind))
    return controller;
  const TunedController* nearest = nullptr;
  for (const auto& row : study.tuned.controllers) {
    if (row.tuned_for != TunedFor::robust || !row.stable()) continue;
    if (nearest == nullptr ||
        row.design.tuning.worst_constraint < nearest->design.tuning.worst_constraint) {
      nearest = &row;
    }
  }
  return nearest;
}

CandidateController candidate_controller(const Mission& mission, const ControllerStudy& study,
                                         const TunedController& row,
                                         const std::vector<EnsembleMember>& members,
                                         const ProposalOptions& options) {
  CandidateController controller;
  controller.structure = row.structure;
  controller.design = row.design;
  controller.member_rms = infinity;
  if (!controller.stable() || !row.ensemble) return controller;
  const EnsembleResult& ensemble = *row.ensemble;
  controller.ensemble = ensemble;
  controller.member_rms = rms_over_members(ensemble);
  controller.constraints_met = controller.design.tuning.status == TuningStatus::optimal &&
                               ensemble.within_constraints == static_cast<int>(members.size());
  TrackingProblem problem = tracking_problem(mission);
  problem.wind.mean_speed = row.wind_speed;
  const auto& gains = controller.design.tuning.controller;
  if (options.time_domain) {
    const auto how = comparison_options(mission, options.seed);
    auto run = study.time_domain ? run_of(*study.time_domain, row) : std::nullopt;
    if (!run) run = compare_in_time_domain(mission, problem, {description_of(row), gains}, how);
    if (run) {
      controller.time_domain = std::move(run->result);
      controller.expected = std::move(run->rms);
    }
    controller.limit_cycle_free =
        !controller.time_domain ||
        is_limit_cycle_free(controller.time_domain->limit_cycles, how.allowed_limit_cycle);
  }
  controller.budgets_met =
      plants_within_budgets(problem, members, gains, study.tuned.goals, mission.budgets,
                            controller.effect().for_budgets(), 1);
  return controller;
}

TunedCandidate tune_candidate(const Mission& mission, const PlantEnsemble& ensemble,
                              const TuneOptions& how, const ProposalOptions& options) {
  const ControllerStudy study =
      options.time_domain ? study_controllers(mission, ensemble, how)
                          : ControllerStudy{tune_structures(mission, ensemble, how), std::nullopt};
  TunedCandidate candidate;
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  candidate.whole = !stopped();
  const TunedController* standing = standing_for(study);
  std::vector<const TunedController*> rows;
  for (const auto& row : study.tuned.controllers) {
    const bool alike = standing == nullptr || (row.tuned_for == standing->tuned_for &&
                                               row.wind_speed == standing->wind_speed);
    if (row.tuned_for == TunedFor::present || !alike) continue;
    if (&row == standing) candidate.chosen = rows.size();
    rows.push_back(&row);
  }
  candidate.controllers.resize(rows.size());
  numerics::for_each_index(rows.size(), options.threads, [&](std::size_t i) {
    if (stopped()) return;
    candidate.controllers[i] =
        candidate_controller(mission, study, *rows[i], ensemble.members, options);
  });
  candidate.whole = candidate.whole && !stopped();
  return candidate;
}

}  // namespace

TunedCandidates tune_candidates(const std::vector<ProposedAntenna>& antennas,
                                const PlantUncertainty& uncertainty, int starts,
                                const ProposalOptions& options) {
  for (const auto& one : antennas) {
    if (options.time_domain) continue;
    for (const auto& loop : one.structures.loops) {
      if (!loop.structure.has_conditional_integral()) continue;
      throw InvalidInput(fmt::format(
          "{}: expected the time domain for {}, an integral with a dead zone or freeze, found none",
          one.name, loop.name));
    }
    if (one.structures.state_space_named) {
      throw InvalidInput(fmt::format(
          "{}: expected the time domain for a state space ({}), which starts from the loops that "
          "are best there, found none",
          one.name, state_space_name));
    }
  }
  // Of each candidate, and of the samples that follow.
  constexpr std::size_t steps = 1000;
  TunedCandidates result;
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    const Mission& mission = antennas[i].mission;
    PlantEnsemble ensemble;
    ensemble.members = members_of(antennas.front().mission, mission, uncertainty, options.seed);
    TuneOptions how;
    how.structures = antennas[i].structures;
    if (!options.time_domain) how.structures.state_space = false;
    how.starts = starts;
    how.seed = options.seed;
    how.threads = options.threads;
    how.interrupted = options.interrupted;
    if (options.progress) {
      how.progress = [&](std::size_t done, std::size_t all) {
        options.progress(steps * i + steps * done / all, steps * (antennas.size() + 1));
      };
    }
    result.members = ensemble.members.size();
    result.candidates.push_back(tune_candidate(mission, ensemble, how, options));
  }
  return result;
}

}  // namespace boresight::design
