#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// Constraints, budgets and plants for which the controllers of a finished study fall short, with
/// the closest values reached. Empty if every wind speed has a controller that meets all of them.
std::vector<Shortfall> find_shortfalls(const TuneSection& section);

/// A few sentences on the table: the best controller, before and after, the price of robustness,
/// the active constraints.
std::vector<std::string> conclude(const TuneSection& section);

}  // namespace boresight::app
