#pragma once

#include <boresight/app/tune/tune_study.hpp>
#include <boresight/design/limits/pointing_limit.hpp>

namespace boresight::app {

/// The laws of a finished study that were tuned at one wind speed (m/s), and the present gains,
/// against the least any controller could do there (design/limits/pointing_limit.hpp).
/// @throws as design::pointing_limit.
design::PointingLimit pointing_limit_of(const io::Case& antenna, const TuneSection& section,
                                        const PlantEnsemble& ensemble, double wind_speed,
                                        unsigned threads);

}  // namespace boresight::app
