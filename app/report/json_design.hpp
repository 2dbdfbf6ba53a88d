#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <boresight/design/design_study.hpp>
#include <boresight/design/plant_ensemble.hpp>
#include <boresight/design/wind_climate.hpp>

namespace boresight::app {

using Json = nlohmann::ordered_json;

/// JSON has neither infinity nor NaN: null.
Json number(double value);
/// null for an empty text.
Json text_or_null(const std::string& text);

/// Share of the climate's time up to a speed (m/s); null without a climate, or if it is not a
/// number.
Json share_of_time_json(const std::vector<design::ClimatePart>& climate, double speed);

Json mode_json(const plant::PlantMode& mode);
/// A tuned law with its verification, "design" of docs/report.schema.json.
Json design_json(const design::Design& design);
/// A law on every member of an ensemble.
Json ensemble_json(const design::EnsembleResult& ensemble);

}  // namespace boresight::app
