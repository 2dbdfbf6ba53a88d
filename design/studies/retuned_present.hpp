#pragma once

#include <string>

#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// The controller that stands for an antenna's present one whose gains are not known: the present
/// structure, tuned for the study's plant. Without a `present_structure` (empty): the structure of
/// fewest gains, the first by name of several. The robust design of that wind speed (m/s), the
/// nominal one where the robust is unstable. Null without a stable design of that structure.
const TunedController* retuned_present(const TuningStudy& study,
                                       const std::string& present_structure, double wind_speed);

}  // namespace boresight::design
