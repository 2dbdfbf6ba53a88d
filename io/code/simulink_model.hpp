#pragma once

#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {

/// servo_model.m: a script for MATLAB and Octave without toolboxes. It defines the linear feedback
/// as a sampled state space (struct `feedback`: A, B, C, D, Ts, names; SI at the motor shaft) and
/// in blocks (struct array `blocks`: path, name, numerator and denominator in 1/z, in the order of
/// each path; of a state space its modal blocks), compares their responses, and where Simulink is
/// installed builds the model servo_loop: feedback, valve limit and one sample of computation.
CodeFile simulink_model(const design::ExportedController& exported);

}  // namespace boresight::io
