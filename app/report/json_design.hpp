#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <boresight/design/design_study.hpp>
#include <boresight/design/plant_ensemble.hpp>

namespace boresight::app {

using Json = nlohmann::ordered_json;

/// JSON has neither infinity nor NaN: null.
Json number(double value);
/// null for an empty text.
Json text_or_null(const std::string& text);

Json mode_json(const plant::PlantMode& mode);
/// A tuned law with its verification, "design" of docs/report.schema.json.
Json design_json(const design::Design& design);
/// A law on every member of an ensemble.
Json ensemble_json(const design::EnsembleResult& ensemble);

}  // namespace boresight::app
