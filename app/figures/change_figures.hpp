#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/design/studies/change_study.hpp>

namespace boresight::app {

/// The rms of every record over its mean wind speed, before and after a change, and both conditions
/// with their intervals at the wind in which they are compared.
std::vector<Figure> change_figures(const design::ChangeStudy& study);

}  // namespace boresight::app
