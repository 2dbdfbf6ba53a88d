#pragma once

#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {

/// The program as functions for MATLAB and Octave: servo_parameters.m, servo_initial_state.m and
/// servo_controller.m, which a MATLAB Function block can call once per sample.
std::vector<CodeFile> octave_code(const control::program::Program& program);

}  // namespace boresight::io
