#pragma once

#include <string>

namespace boresight::app {

/// Consequence of stated present gains that are unstable on the case's plant.
std::string unstable_present_gains(const std::string& structure);

/// What the recommended controller is compared with: "present gains: PI", or "PI tuned for this
/// plant" where the case states no present gains.
std::string present_label(const std::string& structure, bool retuned);

}  // namespace boresight::app
