#pragma once

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// A mode of the plant.
void describe(Visitor& v, const plant::PlantMode& mode);
/// A tuned controller with its verification. Angles on the sky, one axis.
void describe(Visitor& v, const design::Design& design);
/// A controller evaluated with fixed gains on every member of an ensemble.
void describe(Visitor& v, const design::EnsembleResult& ensemble);

}  // namespace boresight::io
