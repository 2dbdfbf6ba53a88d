#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/modal_form.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {

/// What lies on a path from one input of a modal system to one output: all else is left out. The
/// core gives the output and the drives (the forces on the modes, the signals before dead times)
/// from the input and the returns (displacements with their rates, the signals after dead times).
struct ModalReduction {
  /// Rows of the core: 0 the output, 1 + k the drive k. Columns: 0 the input, then the returns'.
  StateSpace core;

  struct Return {
    Eigen::Index column = -1;       // of the core; -1 where only the rate enters
    Eigen::Index rate_column = -1;  // of the core; -1 where the rate does not enter
    bool is_dead_time = false;
    double delay = 0.0;  // s, of a dead time
  };
  std::vector<Return> returns;

  /// How drive k moves return j: through the modes with a gain each, or through a dead time.
  struct Path {
    std::size_t to_return = 0;
    std::size_t from_drive = 0;
    Eigen::VectorXd gain;  // of each mode; empty for a dead time
    /// What of the path is in the core already: its value at frequency 0 where the core alone has
    /// poles on the axis (integrators) that the whole has not, else 0. To be taken off.
    double within_core = 0.0;
  };
  std::vector<Path> paths;

  /// Drives that depend on a return: only these need an equation to be solved. The others are known
  /// from the input alone.
  std::vector<bool> in_loop;

  Eigen::VectorXd mode_frequency;      // rad/s
  Eigen::VectorXd mode_damping_ratio;  // only of modes that some path uses

  /// entry(r, c): whether the core leads from column c to row r at all.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> entry;
};

/// @throws InvalidInput as validate(system), for a name that is not among its inputs or outputs, or
/// for more than 16 drives between the two.
ModalReduction reduce(const ModalSystem& system, std::string_view input, std::string_view output);

inline constexpr std::size_t max_drives = 16;

}  // namespace boresight::plant
