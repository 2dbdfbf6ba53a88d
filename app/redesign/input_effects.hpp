#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/studies/number_effects.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/movable_numbers.hpp>

namespace boresight::app {

/// Effect of one number of the case on the rms of a tuned controller, in the case's design wind.
struct InputEffect : io::MovableNumber, design::NumberEffect {
  /// Mode whose wind fraction or beam weight this is, by its frequency; empty for any other number.
  std::string mode = {};
};

/// io::movable_numbers of the case by design::number_effects.
std::vector<InputEffect> input_effects(const io::Case& antenna,
                                       const control::Controller& controller,
                                       const design::Constraints& goals, double rms,
                                       std::size_t maximum, unsigned threads);

/// design::combined_range of the effects (rad).
design::RmsRange combined_range(const std::vector<InputEffect>& effects, double rms);

/// What friction alone adds to the simulated rms (rad), where that is a telling_change of `rms`,
/// the linear one; 0 elsewhere.
double telling_friction(const std::optional<TimeDomainSection>& time_domain, double rms);

/// Which of them to measure first, in a sentence; empty where none changes the rms by what decides
/// anything. And that friction is to be measured, with a telling_friction, unless it is.
std::string measure_first(const std::vector<InputEffect>& effects, double rms,
                          const std::optional<TimeDomainSection>& time_domain = std::nullopt,
                          bool friction_measured = false);

}  // namespace boresight::app
