#pragma once

#include <optional>
#include <string>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::app {

/// limit_cycle_cell of the runs at rest, or of those at the tracking rate; "-" without them.
std::string limit_cycle_cell(const design::NonlinearVerification& run, bool at_rest);

/// Time (s) from the end of a slew's command until the encoder stays settled: "3.24", "at once", or
/// "> 40" where it did not settle within the `watched` time (s); "-" without a slew.
std::string settling_cell(const std::optional<design::SlewResult>& slew, double watched);

}  // namespace boresight::app
