#pragma once

#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// The problem for which a study tunes at a mean wind speed (m/s): over the mission's climate where
/// the study minimises that.
TrackingProblem problem_at(const Mission& mission, const TuningStudy& study, double wind_speed);

/// Sets what a controller with its design and wind speed means at the sky and on the ensemble: rms,
/// speed limits without a nonlinear effect, ensemble, trade of the position gain, and from these
/// whether its constraints are met. Of an unstable one the figures are NaN.
void evaluate_at_sky(const Mission& mission, const PlantEnsemble& ensemble,
                     const TuningStudy& study, TunedController& row);

}  // namespace boresight::design
