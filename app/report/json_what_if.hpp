#pragma once

#include <boresight/app/match/what_if.hpp>
#include <boresight/app/report/json_design.hpp>

namespace boresight::app {

/// "what_if" of docs/report.schema.json. Rms of five digits; null where unstable.
Json what_if_json(const WhatIfTable& table);

}  // namespace boresight::app
