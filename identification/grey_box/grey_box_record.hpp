#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// A record as the grey box reads it: torques at the motor shaft by the stated efficiency and
/// displacement, thinned to the band of the drive.
struct GreyBoxRecord {
  std::string name;
  TestKind test = TestKind::other;
  double sample_time = 0.0;  // s
  Eigen::VectorXd side_1;    // N m: torque that the inlets' mean pressure gives
  Eigen::VectorXd side_2;    // N m, the outlets'
  Eigen::VectorXd rate;      // rad/s
  /// What drives the predictions, each sample less a twelfth of its second difference: the mean of
  /// two neighbours is then the signal's mean over the step between them, to fourth order.
  Eigen::VectorXd torque;         // N m: side 1 less side 2
  Eigen::VectorXd common;         // N m: mean of both sides, less the campaign's
  Eigen::VectorXd motion;         // rad/s
  Eigen::VectorXd motion_slope;   // rad/s2, by central differences
  Eigen::VectorXd valve;          // rad/s of no-load speed as stated; empty: not known
  bool valve_calibrated = false;  // false: `valve` is a rate command fed to the valve
  /// Samples whose prediction counts; the others were not recorded, or come too soon after a start.
  std::vector<bool> rate_counts;
  std::vector<bool> pressure_counts;
  /// Samples at which the measured rate may correct the predicted one.
  std::vector<bool> rate_known;
  /// Samples at which prediction starts afresh from what is measured (the first is one): of the
  /// rate after a gap in the pressures, of the pressures after any gap.
  std::vector<bool> rate_restarts;
  std::vector<bool> pressure_restarts;
  Eigen::Index samples() const { return rate.size(); }
};

struct GreyBoxRecordOptions {
  /// Samples a second aimed at; records are thinned by whole factors after a low pass of linear
  /// phase, the same for all channels, and never below this.
  double sample_rate = 100.0;
  double settling_time = 1.0;  // s after a start that do not count
};

/// Records without motor rate or without a pressure on either side are left out. A pressure channel
/// that is valid in less than half of a record does not count; the others stand for it.
/// @throws InvalidInput for records whose channels differ in length or whose sample time is not
/// positive, and a sample rate or settling time out of range.
std::vector<GreyBoxRecord> prepare_records(const Campaign& campaign,
                                           const GreyBoxRecordOptions& options = {});

}  // namespace boresight::identification
