#pragma once

#include <vector>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Figures of a commissioning plan: gains by stage; the expected result of each stage with its band
/// over the plants and the abort limit; maximum sensitivity Ms by stage. For two compared records:
/// their spectra and the ratio of rms by band.
std::vector<Figure> commission_figures(const CommissionReport& report);

}  // namespace boresight::app
