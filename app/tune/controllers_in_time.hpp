#pragma once

#include <string>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// Defect of a controller on the nonlinear antenna: "limit-cycles by +-7.42 mdeg". Empty if the
/// controller was not run or is not left_out.
std::string evaluated_against(const TunedController& row);

}  // namespace boresight::app
