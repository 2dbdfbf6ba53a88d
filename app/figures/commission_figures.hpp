#pragma once

#include <vector>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Of a commissioning plan: gains over the stages, what each stage should show with its band over
/// the plants and the abort limit, peaks of S by stage; of two records compared their spectra and
/// the ratio of rms by band.
std::vector<Figure> commission_figures(const CommissionReport& report);

}  // namespace boresight::app
