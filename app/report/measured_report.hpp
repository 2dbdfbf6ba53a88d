#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/document/document.hpp>
#include <boresight/app/tune/measured_study.hpp>

namespace boresight::app {

/// What was measured, the laws, and what each rests on.
Document document_of(const MeasuredTuneSection& section);

/// "measured_tuning" of docs/report.schema.json.
nlohmann::ordered_json measured_tuning_json(const MeasuredTuneSection& section);

/// A sentence a law.
std::vector<std::string> conclude(const MeasuredTuneSection& section);

}  // namespace boresight::app
