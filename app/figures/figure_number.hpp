#pragma once

#include <string>

namespace boresight::app {

/// A figure's number as JSON and CSV write it: six digits, no more than a plot shows. Empty for
/// what is not finite.
std::string figure_number(double value);

}  // namespace boresight::app
