#pragma once

#include <boresight/design/studies/adjustable_loop.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// A loop for the sliders of a report page (app/page/loop_model.js): masses, springs and gains in
/// SI at the motor shaft, in full precision.
void describe(Visitor& v, const design::AdjustableLoop& loop);

}  // namespace boresight::io
