#pragma once

#include <boresight/app/models/linear_models.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "linear_models" of docs/report.schema.json: the state spaces of a report, numbers in the
/// shortest form that reads back bit by bit.
void describe(io::Visitor& v, const LinearModels& models);

}  // namespace boresight::app
