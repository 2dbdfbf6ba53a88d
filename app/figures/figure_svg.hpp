#pragma once

#include <string>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// The figure as one <svg> element without scripts or references, that reads in grey (series differ
/// in dashes and marker shapes too) and prints. Title and caption are its <title> and <desc>.
/// @throws InvalidInput for series whose lengths do not agree, and for a logarithmic axis without a
/// positive value.
std::string to_svg(const Figure& figure);

}  // namespace boresight::app
