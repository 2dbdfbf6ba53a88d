#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// Appends a sentence on a controller's linear rms, gains fixed, under other assumed modal
/// participations of wind and boresight (io::GuessedFractions). `wind_speed` in m/s. Appends
/// nothing if no fraction is assumed or none changes the rms by more than a fifth.
void conclude_guessed_fractions(const io::Case& antenna, const control::Controller& controller,
                                double wind_speed, std::vector<std::string>& sentences);

}  // namespace boresight::app
