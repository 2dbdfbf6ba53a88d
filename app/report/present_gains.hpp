#pragma once

#include <string>

namespace boresight::app {

/// Consequence of stated present gains that are unstable on the case's plant.
std::string unstable_present_gains(const std::string& structure);

}  // namespace boresight::app
