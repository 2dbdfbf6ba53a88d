#pragma once

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/models/linear_models.hpp>

namespace boresight::app {

/// The state spaces of a report, `linear_models` of docs/report.schema.json: numbers in the
/// shortest form that reads back bit by bit.
nlohmann::ordered_json linear_models_json(const LinearModels& models);

}  // namespace boresight::app
