#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// One sentence for each bound of the search that gains of tuned laws of a study end at, in the
/// order of the laws; it names the laws. Present and unstable laws are left out.
std::vector<std::string> gains_at_bounds(const std::vector<const TunedLaw*>& laws);

}  // namespace boresight::app
