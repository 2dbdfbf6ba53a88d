#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::io {

/// What a controller's file holds, as it is written there (docs/benchmark-protocol.md).
struct ControllerText {
  Eigen::MatrixXd a, b, c, d;
  double sample_time = 0.0;  // s; 0: continuous
  std::vector<std::string> inputs, outputs;
  /// One a signal, or none: SI.
  std::vector<std::string> input_units, output_units;
  /// Which axis the angles are of: "motor" (default) or "sky".
  std::string angles = "motor";
};

/// What stands in for names that the file does not hold, and which state space is meant where it
/// holds several.
struct ControllerNames {
  std::vector<std::string> inputs, outputs;
  /// A structure at the top of a MAT file, or a part of `linear_models` in a JSON report, such as
  /// "sampled_controller"; empty: "controller" where there is one, else what the file has.
  std::string part = {};
};

/// A controller as control::antenna_state_space_controller takes it, and what was made of the file.
struct ControllerFile {
  plant::StateSpace system;
  std::vector<std::string> remarks;
};

/// Reads a state space of somebody else: MAT of version 5 (either byte order, compressed or not;
/// matrices A, B, C, D, a number Ts, texts or cells of names) or JSON. Which it is the content
/// says. @throws InvalidInput naming the file for what is damaged or missing, sizes that do not
/// fit, elements that are not finite, names and units that are not known.
ControllerFile read_controller(const std::string& path, double gear_ratio,
                               const ControllerNames& names = {});
/// The same of a file's content.
ControllerFile parse_controller(std::string_view content, const std::string& name,
                                double gear_ratio, const ControllerNames& names = {});

ControllerText controller_from_mat(std::string_view content, const std::string& name,
                                   const std::string& part = {});
ControllerText controller_from_json(std::string_view content, const std::string& name,
                                    const std::string& part = {});
/// The part asked for out of those that a file has, or "controller", or none: the file as a whole.
/// @throws InvalidInput naming the parts there are if the one asked for is not among them.
std::string chosen_part(const std::vector<std::string>& parts, const std::string& asked,
                        const std::string& file);

/// A controller's file: MAT of version 5 where the path ends in .mat, else JSON. SI, angles at the
/// motor. @throws InvalidInput where it cannot be written.
void write_controller(const std::string& path, const plant::StateSpace& controller);
std::string controller_mat(const plant::StateSpace& controller);
std::string controller_json(const plant::StateSpace& controller);

/// Gains from a file: TOML with the keys of [gains] (in that table or at the top), or the JSON
/// report of `boresight tune`, of which written_controller_of_report.
/// @throws InvalidInput naming the file.
struct GainsFile {
  control::ControlLaw law;
  std::string description;  // "PI, robust, of report.json"
};
GainsFile read_gains_file(const std::string& path, const Case& antenna,
                          const std::string& structure = {});

}  // namespace boresight::io
