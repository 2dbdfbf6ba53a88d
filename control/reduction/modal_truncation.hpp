#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Contribution of one mode (a real pole or a pair) to the response.
struct ModeContribution {
  std::string name;           // mode_1, mode_2, ... by rising magnitude of the pole
  std::complex<double> pole;  // 1/s (sampled: in the z plane); of a pair that with Im > 0
  /// Its largest gain over all frequencies, Frobenius norm over inputs and outputs. For one input
  /// or one output this is the largest singular value, otherwise an upper bound of it. Infinite for
  /// a mode that is not stable. With ModalTruncationOptions::keep_static_gain its value at
  /// frequency 0 is subtracted from the response first.
  double peak_gain = 0.0;
};

struct ModalTruncationOptions {
  /// Modes to drop, by name.
  std::vector<std::string> dropped{};
  /// Alternatively, drop as many modes as possible, in the order of rising peak gain, while the
  /// error bound does not exceed this.
  std::optional<double> error_bound{};
  /// Preserve the gain at frequency 0 by adding that of the dropped modes to D.
  bool keep_static_gain = false;
};

struct ModalTruncation {
  /// Block-diagonal: states NAME for a real pole, NAME.1 and NAME.2 (real and imaginary part of the
  /// modal coordinate) for a pair.
  plant::StateSpace system;
  std::vector<ModeContribution> dropped;
  /// The sum of the dropped modes' peak gains. No gain of (given - reduced), at any frequency and
  /// in any direction, exceeds it.
  double error_bound = 0.0;
};

/// The modes of a system and their contributions. O(n^3).
/// @throws InvalidInput as validate(system); NumericalFailure if the eigenvectors are dependent
/// (condition above plant::highest_modal_condition); use truncate_balanced instead.
std::vector<ModeContribution> mode_contributions(const plant::StateSpace& system,
                                                 bool keep_static_gain = false);

/// Removes modes. Kept modes may be unstable or integrators; dropped ones must be stable.
/// @throws as mode_contributions; InvalidInput if both or none of `dropped` and `error_bound` are
/// given, for a name that is no mode's or a bound below 0, or for a dropped mode that is not
/// stable, naming it.
ModalTruncation truncate_modes(const plant::StateSpace& system,
                               const ModalTruncationOptions& options);

}  // namespace boresight::control
