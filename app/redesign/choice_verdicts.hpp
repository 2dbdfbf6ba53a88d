#pragma once

#include <string>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The choices of a report, other guesses and attitudes aside, under whose law a needed budget has
/// another verdict than under the case's own; empty without one. Choices that do not resonate as
/// measured do not count.
std::string other_choices_text(const Report& report, const TuningSection& section);

/// The same of the antenna's other attitudes.
std::string other_attitudes_text(const Report& report, const TuningSection& section);

/// Where other guesses of the shares of wind and beam than the case's change the rms by
/// telling_change or give a needed budget another verdict; else empty.
std::string guessed_shares_text(const Report& report, const TuningSection& section);

}  // namespace boresight::app
