#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::io {

/// The content of a controller's file, as written there (docs/benchmark-protocol.md).
struct ControllerText {
  Eigen::MatrixXd a, b, c, d;
  double sample_time = 0.0;  // s; 0: continuous
  std::vector<std::string> inputs, outputs;
  /// One a signal, or none: SI.
  std::vector<std::string> input_units, output_units;
  /// Which axis the angles are of: "motor" (default) or "sky".
  std::string angles = "motor";
};

/// Substitutes for names that the file does not hold, and the state space to use if it holds
/// several.
struct ControllerNames {
  std::vector<std::string> inputs, outputs;
  /// A structure at the top of a MAT file, or a part of `linear_models` in a JSON report, such as
  /// "sampled_controller"; empty: "controller" where there is one, else what the file has.
  std::string part = {};
};

/// A controller as input of control::antenna_state_space_controller, with remarks on the conversion
/// of the file.
struct ControllerFile {
  plant::StateSpace system;
  std::vector<std::string> remarks;
};

/// Reads an external state space: MAT of version 5 (either byte order, compressed or not; matrices
/// A, B, C, D, a number Ts, texts or cells of names) or JSON. The content determines the format.
/// @throws InvalidInput naming the file for damaged or missing data, inconsistent sizes, elements
/// that are not finite, unknown names and units.
ControllerFile read_controller(const std::string& path, double gear_ratio,
                               const ControllerNames& names = {});
/// The same of a file's content.
ControllerFile parse_controller(std::string_view content, const std::string& name,
                                double gear_ratio, const ControllerNames& names = {});

ControllerText controller_from_mat(std::string_view content, const std::string& name,
                                   const std::string& part = {});
ControllerText controller_from_json(std::string_view content, const std::string& name,
                                    const std::string& part = {});
/// The requested part out of those in a file; or "controller"; or none: the file as a whole.
/// @throws InvalidInput naming the available parts if the requested one is not among them.
std::string chosen_part(const std::vector<std::string>& parts, const std::string& asked,
                        const std::string& file);

/// A controller's file: MAT of version 5 where the path ends in .mat, else JSON. SI, angles at the
/// motor. @throws InvalidInput where it cannot be written.
void write_controller(const std::string& path, const plant::StateSpace& controller);
std::string controller_mat(const plant::StateSpace& controller);
std::string controller_json(const plant::StateSpace& controller);

}  // namespace boresight::io
