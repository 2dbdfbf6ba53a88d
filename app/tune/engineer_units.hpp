#pragma once

#include <string>
#include <vector>

#include <boresight/app/io/case_file.hpp>
#include <boresight/control/control_law.hpp>

namespace boresight::app {

/// The gains of a law in the units that the case writes them in: of the present gains of the same
/// structure, or the lower bounds of a [[loop]], else SI. "0.127 Hz", in the structure's order.
std::vector<std::string> in_engineers_units(const Case& antenna, const control::ControlLaw& law);

/// The laws that the antenna runs on now, by the case: of [gains] and of each [[loop]] with present
/// values.
std::vector<control::ControlLaw> present_laws(const Case& antenna);

}  // namespace boresight::app
