#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/studies/fixed_gain_candidate.hpp>
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
                                   const PlantSample& draw) {
  PlantSample own = draw;
  const double slope = plant::tracking_friction(as_is);
  if (slope > 0.0) {
    own.values.at(static_cast<std::size_t>(UncertainInput::friction_slope)) *=
        plant::tracking_friction(proposed) / slope;
  }
  return plant::linear_plant(plant::changed(proposed, changes_of(own)));
}

FixedGainCandidate::FixedGainCandidate(const plant::Antenna& as_is, const Mission& proposed,
                                       const CandidateController& controller)
    : as_is_(&as_is),
      proposed_(&proposed.antenna),
      effect_(controller.effect()),
      problem_(problem_of(proposed)),
      goals_(constraints(proposed)),
      evaluator_(problem_, controller.design.tuning.controller, goals_) {}

FixedGainCandidate::Outcome FixedGainCandidate::evaluate(const PlantSample& draw) {
  const auto plant = proposed_plant(*as_is_, *proposed_, draw);
  const auto values = evaluator_.evaluate(plant);
  const bool stable =
      evaluator_.near_the_axis(values) ? evaluator_.confirm(plant).stable() : values.stable;
  if (!stable) return {infinity, false};
  const double wind = problem_.climate.empty() ? values.wind_variance : values.climate_variance;
  Outcome outcome;
  outcome.rms =
      effect_.rms(std::sqrt(wind + values.noise_variance) / problem_.gear_ratio) / millidegree;
  outcome.within_constraints = std::sqrt(values.effort_variance) <= goals_.control_effort;
  for (std::size_t b = 0; b < values.sensitivity_peaks.size(); ++b) {
    if (values.sensitivity_peaks.at(b) > goals_.sensitivity_peak.at(b)) {
      outcome.within_constraints = false;
    }
  }
  return outcome;
}

std::optional<DrawnOutcomes> evaluate_samples(const std::vector<FixedGainCandidate>& candidates,
                                              const PlantDistribution& distribution,
                                              const ProposalOptions& options) {
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  const auto random_samples = static_cast<Eigen::Index>(options.random_samples);
  const auto columns = static_cast<Eigen::Index>(candidates.size());
  DrawnOutcomes outcomes{Eigen::MatrixXd::Constant(random_samples, columns, infinity),
                         Eigen::ArrayXXd::Ones(random_samples, columns)};
  constexpr Eigen::Index block = 100;
  const Eigen::Index blocks = (random_samples + block - 1) / block;
  numerics::for_each_index(
      static_cast<std::size_t>(blocks * columns), options.threads, [&](std::size_t task) {
        if (stopped()) return;
        const auto index = static_cast<Eigen::Index>(task);
        const Eigen::Index column = index / blocks;
        const Eigen::Index first = (index % blocks) * block;
        FixedGainCandidate own = candidates[static_cast<std::size_t>(column)];
        for (Eigen::Index d = first; d < std::min(random_samples, first + block); ++d) {
          const auto outcome =
              own.evaluate(distribution.draw(options.seed, static_cast<std::uint64_t>(d)));
          outcomes.rms(d, column) = outcome.rms;
          outcomes.outside(d, column) = outcome.within_constraints ? 0.0 : 1.0;
        }
      });
  if (stopped()) return std::nullopt;
  return outcomes;
}

}  // namespace boresight::design
