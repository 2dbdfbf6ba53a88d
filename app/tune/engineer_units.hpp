#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// The gains of a law in the units that the case writes them in: of the present gains of the same
/// structure, or the lower bounds of a [[loop]], else SI. "0.127 Hz", in the structure's order.
std::vector<std::string> in_engineers_units(const io::Case& antenna,
                                            const control::ControlLaw& law);

/// The laws that the antenna runs on now, by the case: of [gains] and of each [[loop]] with present
/// values.
std::vector<control::ControlLaw> present_laws(const io::Case& antenna);

}  // namespace boresight::app
