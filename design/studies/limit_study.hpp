#pragma once

#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// Compares a finished study's controllers of one wind speed (m/s), and the present gains, with the
/// lower bound for any controller at that speed. See design/limits/pointing_limit.hpp. The refined
/// one starts from the recommended controller, if there is one. With Antenna::nonlinear its
/// PointingLimitOptions::violations are limit_cycle_violations. With an ensemble of
/// EnsembleSource::ranges that has members its corners are corner_members.
/// @throws as pointing_limit and corner_members.
PointingLimit pointing_limit_of(const Mission& mission, const TuningStudy& study,
                                const PlantEnsemble& ensemble, double wind_speed, unsigned threads);

}  // namespace boresight::design
