#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What of the goals, budgets and plant the laws of a finished study do not reach, with the closest
/// that they do. Empty if every wind speed has a law that meets everything.
std::vector<Shortfall> find_shortfalls(const TuneSection& section);

/// A few sentences that say what the table means: the best law, before and after, the price of
/// robustness, what limits.
std::vector<std::string> conclude(const TuneSection& section);

}  // namespace boresight::app
