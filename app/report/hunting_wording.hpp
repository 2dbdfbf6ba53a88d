#pragma once

#include <string>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::app {

/// A limit cycle in a table, of the beam in mdeg: "+-0.3500", "+-0.3500 (2/5)" where not all runs
/// have one, "none", or how a run ended that did not complete.
std::string hunting_cell(const design::HuntingResult& hunting);

/// What such cells are, without a full stop.
std::string hunting_legend();

}  // namespace boresight::app
