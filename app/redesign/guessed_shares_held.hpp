#pragma once

#include <string>
#include <vector>

#include <boresight/app/io/case_file.hpp>
#include <boresight/control/control_law.hpp>

namespace boresight::app {

/// Appends in a sentence what becomes of a law's linear rms, gains held, where all guessed shares
/// of wind and beam are elsewhere (GuessedShares); `wind_speed` in m/s. Nothing where no share is a
/// guess or none of them moves the rms by more than a fifth.
void conclude_guessed_shares(const Case& antenna, const control::ControlLaw& law, double wind_speed,
                             std::vector<std::string>& sentences);

}  // namespace boresight::app
