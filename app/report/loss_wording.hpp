#pragma once

#include <string>

namespace boresight::app {

/// Largest loss (dB) for which the antenna pattern is taken as a parabola: 3 at half the beamwidth.
inline constexpr double largest_parabola_loss = 3.0;

/// A loss for tables and sentences: "0.7424"; "> 3" beyond the validity of the parabolic pattern;
/// "-" if it is not a number.
std::string loss_text(double decibels, int decimals = 4);

/// What "> 3" means, in a sentence to stand below a table that shows losses.
std::string beyond_the_parabola();

}  // namespace boresight::app
