#pragma once

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The gains of the controller that a redesign, `tune`, `match` (for the motors as built) or
/// `evaluate` (for the proposal to choose) recommends, a row each: symbol with name, value with
/// unit; below a subheading that names the controller, or states that it is not to be loaded. Empty
/// without a controller to recommend.
Document gains_to_load(const Report& report);

}  // namespace boresight::app
