#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// Appends in a sentence what becomes of a law's linear rms, gains held, where all guessed shares
/// of wind and beam are elsewhere (io::GuessedShares); `wind_speed` in m/s. Nothing where no share
/// is a guess or none of them moves the rms by more than a fifth.
void conclude_guessed_shares(const io::Case& antenna, const control::ControlLaw& law,
                             double wind_speed, std::vector<std::string>& sentences);

}  // namespace boresight::app
