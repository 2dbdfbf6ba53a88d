#pragma once

#include <string>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// Alternative interpretations of a report whose controller changes the verdict on a required
/// budget; empty without one. Other guesses and attitudes are excluded. Interpretations that miss
/// the measured resonance do not count.
std::string other_interpretations_text(const Report& report, const TuningSection& section);

/// The same of the antenna's other attitudes.
std::string other_attitudes_text(const Report& report, const TuningSection& section);

/// Alternative modal participations of wind and boresight that change the rms by telling_change or
/// the verdict on a required budget; else empty.
std::string guessed_fractions_text(const Report& report, const TuningSection& section);

}  // namespace boresight::app
