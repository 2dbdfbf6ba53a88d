#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// Every point plotted, in the displayed units. Numbers of six digits; null marks a gap.
void describe(io::Visitor& v, const Figure& figure);
/// "figures".
void describe_figures(io::Visitor& v, const std::vector<Figure>& figures);

}  // namespace boresight::app
