#pragma once

#include <string>

#include <boresight/design/pointing_limit.hpp>

namespace boresight::app {

/// The least any controller can do, the benchmarks, and each law against them.
std::string to_text(const design::PointingLimit& limit);

}  // namespace boresight::app
