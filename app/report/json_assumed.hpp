#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::app {

/// "assumed_inputs" of docs/report.schema.json.
nlohmann::ordered_json assumed_json(const std::vector<io::Quantity>& assumed);

}  // namespace boresight::app
