#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/design/studies/candidate_controllers.hpp>
#include <boresight/design/studies/candidate_figures.hpp>
#include <boresight/design/studies/proposal_decision.hpp>
#include <boresight/design/studies/proposal_study.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

ProposedDesign describe(const ProposedAntenna& proposed, std::size_t place) {
  const plant::Antenna& antenna = proposed.mission.antenna;
  ProposedDesign candidate;
  candidate.name = proposed.name;
  candidate.antenna = place;
  candidate.cost = proposed.cost;
  candidate.changed = proposed.changed;
  candidate.motor_inertia = motor_inertia(antenna);
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  candidate.reflected_inertia = candidate.motor_inertia + load;
  candidate.motor_to_load_ratio = candidate.motor_inertia / load;
  candidate.oil_mode = plant::mode_of_oil(plant::plant_modes(plant::linear_plant(antenna)));
  return candidate;
}

// In rising cost, by the rms of those with a usable controller and a cost.
std::vector<std::size_t> front_of(const std::vector<ProposedDesign>& candidates) {
  std::vector<std::size_t> places;
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const CandidateController* controller = candidates[i].chosen_controller();
    if (controller == nullptr || !controller->usable() ||
        !std::isfinite(controller->compared_rms()))
      continue;
    const auto& cost = candidates[i].cost;
    if (!cost) continue;
    places.push_back(i);
    points.push_back({*cost, controller->compared_rms()});
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : pareto_front(points)) front.push_back(places[i]);
  return front;
}

}  // namespace

NonlinearEffect CandidateController::effect() const {
  if (!time_domain) return {};
  const auto& wind = time_domain->wind;
  return NonlinearEffect::of_simulation(expected ? expected->rms.value : wind.boresight_rms,
                                        wind.predicted_rms,
                                        limit_cycle_amplitude(time_domain->limit_cycles));
}

double CandidateController::simulated_to_linear_rms() const {
  return effect().factor;
}

std::optional<double> ProposedDesign::reversal_error() const {
  const CandidateController* controller = chosen_controller();
  if (controller == nullptr || !controller->time_domain || !controller->time_domain->reversal)
    return std::nullopt;
  const auto& reversal = *controller->time_domain->reversal;
  if (reversal.status != RunStatus::complete) return std::nullopt;
  return reversal.boresight_error;
}

ProposalStudy study_proposals(const std::vector<ProposedAntenna>& antennas,
                              const PlantUncertainty& uncertainty, const ProposalOptions& options) {
  constexpr std::size_t min_random_samples = 100;
  if (options.random_samples < min_random_samples) {
    throw InvalidInput(fmt::format("proposals: expected {} samples or more, found {}",
                                   min_random_samples, options.random_samples));
  }
  if (antennas.empty()) throw InvalidInput("proposals: expected an antenna, found none");
  const Mission& as_is = antennas.front().mission;
  for (const auto& one : antennas) validate(constraints(one.mission));

  ProposalStudy study;
  study.starts = options.starts != 0 ? options.starts : as_is.starts;
  if (study.starts == 0) study.starts = TuningOptions{}.starts;
  auto tuned = tune_candidates(antennas, uncertainty, study.starts, options);
  study.ensemble_size = tuned.members;
  if (options.time_domain && as_is.antenna.nonlinear) {
    study.time_domain = comparison_options(as_is, options.seed);
  }
  std::vector<const Mission*> missions;
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    if (!tuned.candidates[i].whole) {
      study.not_run.push_back(i);
      continue;
    }
    ProposedDesign candidate = describe(antennas[i], i);
    candidate.controllers = std::move(tuned.candidates[i].controllers);
    candidate.chosen = tuned.candidates[i].chosen;
    study.candidates.push_back(std::move(candidate));
    missions.push_back(&antennas[i].mission);
  }
  numerics::for_each_index(study.candidates.size(), options.threads, [&](std::size_t i) {
    ProposedDesign& candidate = study.candidates[i];
    if (!candidate.chosen) return;
    candidate.figures = candidate_figures(*missions[i], as_is.bands, as_is.budgets,
                                          candidate.controllers[*candidate.chosen]);
  });
  study.front = front_of(study.candidates);
  const bool stopped = options.interrupted && options.interrupted();
  if (!stopped && study.not_run.empty()) {
    study.decision =
        decide(study.candidates, as_is.antenna, missions, uncertainty.distribution, options);
  }
  if (options.progress) options.progress(1, 1);
  return study;
}

}  // namespace boresight::design
