#pragma once

#include <string>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What the nonlinear antenna has against a law: "hunts by +-7.42 mdeg"; empty where the law did
/// not run or is not left_out.
std::string held_against(const TunedLaw& row);

}  // namespace boresight::app
