#pragma once

#include <string>

namespace boresight::app {

/// The loss (dB) up to which the beam is taken as a parabola: 3 at half its width.
inline constexpr double largest_parabola_loss = 3.0;

/// A loss for tables and sentences: "0.7424", or "> 3" where the beam's parabola does not hold any
/// more; "-" where it is not a number.
std::string loss_text(double decibels, int decimals = 4);

/// What "> 3" means, in a sentence to stand below a table that shows losses.
std::string beyond_the_parabola();

}  // namespace boresight::app
