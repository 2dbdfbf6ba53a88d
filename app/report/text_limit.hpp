#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/design/limits/pointing_limit.hpp>

namespace boresight::app {

/// The least any controller can do, the benchmarks, and each law against them.
Document document_of(const design::PointingLimit& limit);

}  // namespace boresight::app
