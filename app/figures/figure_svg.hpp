#pragma once

#include <string>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// The figure as one <svg> element without scripts or references, that reads in grey (series differ
/// in dashes and marker shapes too) and prints. Title and caption are its <title> and <desc>.
///
/// Colours, dashes and widths are presentation attributes, which any rule of a page's style sheet
/// overrides, on elements of the classes `panel`, `grid`, `axis`, `label` and `series series-0`,
/// `series-1`, ... Each panel's group states its mapping, for scripts that read values off: the
/// edges `data-left`, `-right`, `-top`, `-bottom` in the coordinates of the viewBox and the values
/// `data-x-from`, `-x-to`, `-y-from`, `-y-to` there (from left to right, from bottom to top; on a
/// logarithmic axis, `data-x-scale`, `-y-scale`, their logarithms run evenly).
///
/// @throws InvalidInput for series whose lengths do not agree, and for a logarithmic axis without a
/// positive value.
std::string to_svg(const Figure& figure);

}  // namespace boresight::app
