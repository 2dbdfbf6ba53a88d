#pragma once

#include <string>

namespace boresight::app {

/// What follows where the gains that the antenna is said to run on are unstable on the case's
/// plant.
std::string unstable_present_gains(const std::string& structure);

}  // namespace boresight::app
