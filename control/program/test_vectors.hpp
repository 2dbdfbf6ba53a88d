#pragma once

#include <string>
#include <vector>

#include <boresight/control/program/controller_program.hpp>

namespace boresight::control::program {

/// Inputs of a program and the outputs that it computes from them, to test other implementations.
struct TestVector {
  std::string name;  // "steps", "chirp", "saturation", "wrap", "modes"
  std::string description;
  std::vector<std::vector<double>> inputs;   // a row per sample, in the program's order
  std::vector<std::vector<double>> outputs;  // likewise, in double precision
  /// Per output, the largest difference that rounding accounts for: in double precision 1e-12 of
  /// the output's largest magnitude (at least 1e-12); in single precision `single_margin` times
  /// that of the Interpreter in single precision.
  std::vector<double> double_tolerance, single_tolerance;
};

inline constexpr int test_vector_samples = 500;
inline constexpr double single_margin = 4.0;

/// Steps of the target, a chirp, saturation of the valve and recovery, the encoder's wrap in both
/// directions, and changes of mode with bad inputs; of a rigid axis with sensor noise, the same on
/// every machine. `options`: those of the program.
std::vector<TestVector> test_vectors(const Program& program,
                                     const ControllerProgramOptions& options);

}  // namespace boresight::control::program
