#pragma once

#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// The problem for which a study tunes at a mean wind speed (m/s): over the mission's climate where
/// the study minimises that.
TrackingProblem problem_at(const Mission& mission, const TuningStudy& study, double wind_speed);

/// Computes the pointing figures of a controller from its design and wind speed: boresight rms in
/// that wind and over the climate, wind-speed limits of the budgets without a nonlinear effect,
/// results on the ensemble, trade of the position gain, constraints_met. NaN for an unstable one.
void evaluate_pointing(const Mission& mission, const PlantEnsemble& ensemble,
                       const TuningStudy& study, TunedController& row);

}  // namespace boresight::design
