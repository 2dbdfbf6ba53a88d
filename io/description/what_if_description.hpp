#pragma once

#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Laws held on other plants and in other winds: "what_if" of docs/report.schema.json. Rms of five
/// digits; null where unstable.
void describe(Visitor& v, const design::WhatIfTable& table);

}  // namespace boresight::io
