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

/// One structure tuned on the measured response. Rms and rates at the motor as the tuner has them.
struct MeasuredLaw {
  std::string structure;  // as the user names it
  MeasuredTuningResult tuning;
  /// The same gains on the mission's linear plant, which is another motion's (friction, orifices)
  /// and nobody's measurement: a warning where the two disagree.
  bool stable_on_case = false;            // by eigenvalues
  std::array<double, 3> peaks_on_case{};  // of |S|, order of control::loop_breaks; if stable
};

/// Controllers tuned on what one record shows of its drive.
struct MeasuredTuningStudy {
  double start = 0.0;  // s, of the part used
  double length = 0.0;
  double mean_rate = 0.0;        // rad/s of motor: all holds for motion about it
  double lowest_excited = 0.0;   // Hz, where the valve command has power
  double highest_excited = 0.0;  // Hz
  bool encoder_recorded = false;
  control::OilSpring oil;
  /// Whether the oil spring was fitted to the record; else it is the mission's.
  bool oil_fitted = false;
  std::string oil_failure;  // why the fit failed; empty where it did not
  double gear_ratio = 1.0;
  double wind_speed = 0.0;  // m/s
  std::optional<control::MeasuredChannels> channels;
  MeasuredGoals goals;
  /// Whether the mission has constraints of other kinds, which no law was held to.
  bool other_goals = false;
  std::vector<MeasuredLaw> laws;

  /// A law meets its goals within the confidence and passes its verification.
  bool any_confident() const;
};

/// The response of a record's valve command to tachometer, torque and, where `encoder` has it, the
/// antenna's angle (rad of motor, one a sample), over the longest part in which the drive moves one
/// way (identification::moving_part); then each structure tuned for the mission's constraints on
/// sensitivity peaks and valve effort in its design wind. Nothing of the mission's friction and
/// inertias enters; of its drive the oil spring where the record does not give it, and the
/// tachometer's lag. Without an encoder the mission's structure says how far the encoder's angle
/// differs from the motor's, uncertain by a fifth of the difference. Where options.stop says yes,
/// the laws that are tuned by then.
/// @throws InvalidInput for a record without valve command or with the rate loop closed, an
/// encoder of another length, as tracking_problem, constraints and tune; NumericalFailure where the
/// drive moves one way for less than 1000 samples or the record is not coherent.
MeasuredTuningStudy study_measured_tuning(const Mission& mission,
                                          const identification::Campaign& campaign,
                                          const identification::DriveRecord& record,
                                          const std::optional<Eigen::VectorXd>& encoder,
                                          const std::vector<NamedStructure>& structures,
                                          const MeasuredTuningOptions& options);

}  // namespace boresight::design
