#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/io/case_file.hpp>

namespace boresight::app {

/// From which height to which the case's wind speeds were converted, in a sentence.
std::string mast_in_words(const WindMast& mast);

/// "wind_mast" of docs/report.schema.json.
nlohmann::ordered_json mast_json(const WindMast& mast);

}  // namespace boresight::app
