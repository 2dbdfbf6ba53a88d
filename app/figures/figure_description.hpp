#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// Every point plotted, in the units that a reader sees. Numbers of six digits; null stands for a
/// gap.
void describe(io::Visitor& v, const Figure& figure);
/// "figures".
void describe_figures(io::Visitor& v, const std::vector<Figure>& figures);

}  // namespace boresight::app
