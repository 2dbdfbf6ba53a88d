#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Figures of a commissioning plan: gains by stage; the expected result of each stage with its band
/// over the plants and the abort limit; maximum sensitivity Ms by stage; the expected Bode plot of
/// each stage. For two compared records:
/// their spectra and the ratio of rms by band.
std::vector<Figure> commission_figures(const CommissionReport& report);

/// The Bode plot that is expected of one stage, by its index, with its band over the plants, under
/// a section's heading. None where a plant is unstable.
std::optional<Figure> stage_bode_figure(const CommissionReport& report, std::size_t stage,
                                        const std::string& section);

}  // namespace boresight::app
