#pragma once

#include <nlohmann/json.hpp>

#include <boresight/design/limits/pointing_limit.hpp>

namespace boresight::app {

/// "limit" of docs/report.schema.json: every number that a ratio is made of stands beside it.
nlohmann::ordered_json limit_json(const design::PointingLimit& limit);

}  // namespace boresight::app
