#pragma once

#include <boresight/app/report/redesign_card.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The card's line of Ms, margins, overshoot, and on how many plants the constraints are met. The
/// report must have `tuning`.
CardLine margins_line(const Report& report);

}  // namespace boresight::app
