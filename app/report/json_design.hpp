#pragma once

#include <nlohmann/json.hpp>

#include <boresight/app/report/json_number.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/design_study.hpp>

namespace boresight::app {

Json mode_json(const plant::PlantMode& mode);
/// A tuned law with its verification, "design" of docs/report.schema.json.
Json design_json(const design::Design& design);
/// A law on every member of an ensemble.
Json ensemble_json(const design::EnsembleResult& ensemble);

}  // namespace boresight::app
