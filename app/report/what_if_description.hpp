#pragma once

#include <boresight/app/match/what_if_table.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "what_if" of docs/report.schema.json. Rms of five digits; null where unstable.
void describe(io::Visitor& v, const WhatIfTable& table);

}  // namespace boresight::app
