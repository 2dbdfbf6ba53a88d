#pragma once

#include <vector>

#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {

/// The program in C99: servo_controller.h and servo_controller.c. No allocation, recursion, loops
/// or library beyond math.h; all state in a struct of the caller's, so that it is reentrant. `wide`
/// variables are double in either precision.
std::vector<CodeFile> c_code(const control::program::Program& program,
                             control::program::Precision precision);

/// servo_controller_test.c: runs the test vectors (control::program::test_vectors) in a folder and
/// compares the outputs; exit code 1 if one differs by more than its tolerance.
CodeFile c_test_program(const control::program::Program& program);

}  // namespace boresight::io
