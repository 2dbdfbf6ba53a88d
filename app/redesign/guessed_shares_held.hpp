#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// Appends a sentence on a controller's linear rms, gains fixed, under other assumed modal
/// participations of wind and boresight (io::GuessedShares). `wind_speed` in m/s. Appends nothing
/// if no fraction is assumed or none changes the rms by more than a fifth.
void conclude_guessed_shares(const io::Case& antenna, const control::ControlLaw& law,
                             double wind_speed, std::vector<std::string>& sentences);

}  // namespace boresight::app
