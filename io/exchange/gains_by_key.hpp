#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// A structure (loop_structure) with all its gains by KEY=VALUE, as [gains] has them: symbol and
/// quantity, "wi=0.3 rad/s".
/// @throws InvalidInput for a gain that is missing, a key that the structure has not, a value of
/// another kind or out of range, and as loop_structure.
control::Controller controller_by_key(const Case& antenna, const std::string& structure,
                                      const std::vector<std::string>& gains);

}  // namespace boresight::io
