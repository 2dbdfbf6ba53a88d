#pragma once

#include <boresight/design/studies/state_space_study.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// The robust LQG on the nonlinear antenna, beside the recommended loops.
void describe(Visitor& v, const design::StateSpaceStudy& study);

}  // namespace boresight::io
