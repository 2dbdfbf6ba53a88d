#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/studies/held_candidate.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TrackingProblem problem_of(const Mission& mission) {
  TrackingProblem problem = tracking_problem(mission);
  if (mission.minimises_climate) problem.climate = mission.climate;
  return problem;
}

}  // namespace

plant::AntennaPlant proposed_plant(const plant::Antenna& as_is, const plant::Antenna& proposed,
                                   const PlantDraw& draw) {
  PlantDraw own = draw;
  const double slope = plant::tracking_friction(as_is);
  if (slope > 0.0) {
    own.values.at(static_cast<std::size_t>(UncertainInput::friction_slope)) *=
        plant::tracking_friction(proposed) / slope;
  }
  return plant::linear_plant(plant::changed(proposed, changes_of(own)));
}

HeldCandidate::HeldCandidate(const plant::Antenna& as_is, const Mission& proposed,
                             const CandidateLaw& law)
    : as_is_(&as_is),
      proposed_(&proposed.antenna),
      effect_(law.effect()),
      problem_(problem_of(proposed)),
      goals_(constraints(proposed)),
      evaluator_(problem_, law.design.tuning.law, goals_) {}

HeldCandidate::Outcome HeldCandidate::judge(const PlantDraw& draw) {
  const auto plant = proposed_plant(*as_is_, *proposed_, draw);
  const auto values = evaluator_.evaluate(plant);
  const bool stable =
      evaluator_.near_the_axis(values) ? evaluator_.confirm(plant).stable() : values.stable;
  if (!stable) return {infinity, false};
  const double wind = problem_.climate.empty() ? values.wind_variance : values.climate_variance;
  Outcome outcome;
  outcome.rms =
      effect_.rms(std::sqrt(wind + values.noise_variance) / problem_.gear_ratio) / millidegree;
  outcome.within_goals = std::sqrt(values.effort_variance) <= goals_.valve_effort;
  for (std::size_t b = 0; b < values.sensitivity_peaks.size(); ++b) {
    if (values.sensitivity_peaks.at(b) > goals_.sensitivity_peak.at(b)) {
      outcome.within_goals = false;
    }
  }
  return outcome;
}

std::optional<DrawnOutcomes> judge_draws(const std::vector<HeldCandidate>& held,
                                         const PlantDistribution& distribution,
                                         const ProposalOptions& options) {
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  const auto draws = static_cast<Eigen::Index>(options.draws);
  const auto columns = static_cast<Eigen::Index>(held.size());
  DrawnOutcomes outcomes{Eigen::MatrixXd::Constant(draws, columns, infinity),
                         Eigen::ArrayXXd::Ones(draws, columns)};
  constexpr Eigen::Index block = 100;
  const Eigen::Index blocks = (draws + block - 1) / block;
  numerics::for_each_index(
      static_cast<std::size_t>(blocks * columns), options.threads, [&](std::size_t task) {
        if (stopped()) return;
        const auto index = static_cast<Eigen::Index>(task);
        const Eigen::Index column = index / blocks;
        const Eigen::Index first = (index % blocks) * block;
        HeldCandidate own = held[static_cast<std::size_t>(column)];
        for (Eigen::Index d = first; d < std::min(draws, first + block); ++d) {
          const auto outcome =
              own.judge(distribution.draw(options.seed, static_cast<std::uint64_t>(d)));
          outcomes.rms(d, column) = outcome.rms;
          outcomes.outside(d, column) = outcome.within_goals ? 0.0 : 1.0;
        }
      });
  if (stopped()) return std::nullopt;
  return outcomes;
}

}  // namespace boresight::design
