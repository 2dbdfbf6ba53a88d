#pragma once

#include <optional>
#include <string>

#include <boresight/app/redesign/input_effects.hpp>

namespace boresight::app {

/// The test of the antenna to make next, for the number of the case that the rms depends on most.
struct NextTest {
  std::string key;   // of the case's number; empty: friction, by what the simulation shows of it
  std::string test;  // what to do, with the antenna time it takes
  std::string quantity;  // what it measures, in words; the key where they are not known
};

/// None where no number moves the rms by what decides anything, and friction is measured or costs
/// little on the nonlinear antenna. `effects`: largest first, of the linear rms (rad).
std::optional<NextTest> next_test(const std::vector<InputEffect>& effects, double rms,
                                  const std::optional<TimeDomainSection>& time_domain,
                                  bool friction_measured = false);

}  // namespace boresight::app
