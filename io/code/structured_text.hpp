#pragma once

#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {

/// The program as the function block SERVO_CONTROLLER in Structured Text (IEC 61131-3, third
/// edition): servo_controller.st. Types BOOL, DINT, REAL and LREAL with explicit conversions only;
/// `wide` variables are LREAL in either precision.
CodeFile structured_text(const control::program::Program& program,
                         control::program::Precision precision);

}  // namespace boresight::io
