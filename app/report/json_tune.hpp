#pragma once

#include <boresight/app/report/json_design.hpp>
#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// "tuned" of docs/report.schema.json.
Json tune_json(const TuneSection& section);

/// One of its "laws".
Json law_json(const TuneSection& section, const TunedLaw& row);

}  // namespace boresight::app
