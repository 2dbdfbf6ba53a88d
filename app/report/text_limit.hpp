#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/design/limits/pointing_limit.hpp>

namespace boresight::app {

/// The lower bound of any controller, the benchmarks, and each controller against them.
Document document_of(const design::PointingLimit& limit);

}  // namespace boresight::app
