#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/problem/mission.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>
#include <boresight/identification/records/drive_record.hpp>

namespace boresight::design {

/// One structure tuned on the measured response. Rms and rates at the motor shaft, as in the tuner.
struct MeasuredController {
  std::string structure;  // as the user names it
  MeasuredTuningResult tuning;
  /// The same gains on the mission's linear plant. That plant is unmeasured and holds for another
  /// motion (friction, orifices): a disagreement is a warning.
  bool stable_on_case = false;            // by eigenvalues
  std::array<double, 3> peaks_on_case{};  // Ms, order of control::loop_breaks; if stable
};

/// Controllers tuned on the drive's response measured in one record.
struct MeasuredTuningStudy {
  double start = 0.0;  // s, of the part used
  double length = 0.0;
  double mean_rate = 0.0;        // rad/s of motor: all results hold for motion about this rate
  double lowest_excited = 0.0;   // Hz, where the valve command has power
  double highest_excited = 0.0;  // Hz
  bool encoder_recorded = false;
  control::OilSpring oil;
  /// True if the oil spring was fitted to the record; otherwise it is the mission's.
  bool oil_fitted = false;
  std::string oil_failure;  // reason of a failed fit; empty if it succeeded
  double gear_ratio = 1.0;
  double wind_speed = 0.0;  // m/s
  std::optional<control::MeasuredChannels> channels;
  MeasuredConstraints goals;
  /// True if the mission has constraints of other kinds than these and Constraints::standstill. The
  /// tuning ignores both.
  bool other_goals = false;
  std::vector<MeasuredController> controllers;

  /// True if a controller meets its constraints within the confidence region and passes its
  /// verification.
  bool any_confident() const;
};

/// Estimates the response of tachometer, torque and, where `encoder` has it, the antenna's angle
/// (rad of motor, one per sample) to a record's valve command. It uses the longest part in which
/// the drive moves one way (identification::moving_part). Then it tunes each structure for the
/// mission's constraints on Ms and control effort in its design wind. It uses neither the mission's
/// friction nor its inertias. From the mission's drive it uses the tachometer's lag, and the oil
/// spring if the record does not determine it. Without an encoder, the mission's structure predicts
/// the difference between encoder and motor angle, with an uncertainty of a fifth of that
/// difference. If options.stop returns true, the result holds the controllers tuned by then.
/// @throws InvalidInput for a record without valve command or with the rate loop closed, an encoder
/// of another length, as tracking_problem, constraints and tune; NumericalFailure where the drive
/// moves one way for less than 1000 samples or the record is not coherent.
MeasuredTuningStudy study_measured_tuning(const Mission& mission,
                                          const identification::Campaign& campaign,
                                          const identification::DriveRecord& record,
                                          const std::optional<Eigen::VectorXd>& encoder,
                                          const std::vector<NamedStructure>& structures,
                                          const MeasuredTuningOptions& options);

}  // namespace boresight::design
