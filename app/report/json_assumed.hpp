#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/io/quantity.hpp>

namespace boresight::app {

/// "assumed_inputs" of docs/report.schema.json.
nlohmann::ordered_json assumed_json(const std::vector<Quantity>& assumed);

}  // namespace boresight::app
