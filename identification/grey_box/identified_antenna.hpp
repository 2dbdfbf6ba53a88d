#pragma once

#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::identification {

/// What an antenna takes from its records; all else stays as the antenna has it. Inertias and oil
/// always come from the estimate, whose prior is what drawings and data sheets say of them.
struct IdentifiedParts {
  bool leakage_rate = true;
  bool friction_curve = true;
  bool friction_slope = false;  // of the linear plant, that of the curve at the tracking rate
  bool offset_torque = true;
  bool bristles = true;
  bool valve_lag = false;
  /// One a mode of DriveEstimate::mode_frequency, rising. Modes beyond these, and all where the
  /// list is empty, keep their proportion to the lowest.
  std::vector<bool> frequencies;
};

/// What the records show, GreyBoxQuantity::identified and GreyBoxParameterResult::identified: the
/// friction curve where its level or its slope is, the slope where its interval is above 0.
IdentifiedParts identified_parts(const GreyBoxResult& result);

/// What makes an antenna the one that its records show: inertias, oil, leakage, friction curve and,
/// where the records show the structure, its frequencies. Motors and antenna by the estimate, the
/// gear train as stated. The volumes of oil make up for what the convention about efficiencies
/// makes of the estimated stiffness; the valve's frequency is that of the estimated lag with the
/// antenna's damping ratio; nonlinear numbers only where the antenna has a nonlinear drive.
/// Frequencies with the motors held are moved to the identified ones as
/// with_motors_held_frequencies says; where no antenna has them, all in the proportion of the
/// lowest.
/// @throws NumericalFailure for an estimate that is contradicted, or that leaves the antenna no
/// inertia beside motors and gear train.
std::vector<plant::AntennaChange> identified_changes(const plant::Antenna& antenna,
                                                     const DriveEstimate& estimate,
                                                     const IdentifiedParts& parts = {});

/// A number of identified_changes by its path (AntennaChange), without those that are scaled. Its
/// standard uncertainty is the samples' scatter. Samples that leave the antenna no inertia are
/// excluded.
struct IdentifiedNumber {
  std::string path;
  double value = 0.0;  // SI, as the path's number
  double standard_uncertainty = 0.0;
};
std::vector<IdentifiedNumber> identified_numbers(const plant::Antenna& antenna,
                                                 const DriveEstimate& estimate,
                                                 const std::vector<DriveEstimate>& random_samples,
                                                 const IdentifiedParts& parts = {});

}  // namespace boresight::identification
