#pragma once

#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Controllers evaluated with fixed gains on other plants and in other winds: "what_if" of
/// docs/report.schema.json. Rms to five digits; null if unstable.
void describe(Visitor& v, const design::WhatIfTable& table);

}  // namespace boresight::io
