#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/tuning/measured_tuning.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// What to tune on a record of the case.
struct MeasuredStudyOptions {
  std::string record;                   // its name
  std::vector<std::string> structures;  // short names; empty: PI and DPF
  int starts = 0;                       // 0: as the tuner has it
  std::uint64_t seed = 1;
  /// Asked now and then; true ends the work with what was found.
  std::function<bool()> interrupted;
};

/// One structure tuned on the measured response. Rms and rates at the motor as the tuner has them.
struct MeasuredLaw {
  std::string structure;  // as the user names it
  design::MeasuredTuningResult tuning;
  /// The same gains on the case's linear plant, which is another motion's (friction, orifices) and
  /// nobody's measurement: a warning where the two disagree.
  bool stable_on_case = false;            // by eigenvalues
  std::array<double, 3> peaks_on_case{};  // of |S|, order of control::loop_breaks; if stable
};

/// What `boresight tune --measured` found.
struct MeasuredTuneSection {
  std::string record;
  double start = 0.0;  // s, of the part used
  double length = 0.0;
  double mean_rate = 0.0;        // rad/s of motor: all holds for motion about it
  double lowest_excited = 0.0;   // Hz, where the valve command has power
  double highest_excited = 0.0;  // Hz
  std::string encoder_column;    // empty: none, see tune_measured
  control::OilSpring oil;
  std::string oil_source;
  double gear_ratio = 1.0;
  double wind_speed = 0.0;  // m/s
  std::optional<control::MeasuredChannels> channels;
  design::MeasuredGoals goals;
  std::vector<MeasuredLaw> laws;
  /// What is assumed and what is not judged, a sentence each.
  std::vector<std::string> notes;

  /// A law meets its goals within the confidence and passes its verification.
  bool any_confident() const;
};

/// The response of a record's valve command to tachometer, torque and, from a column of the file
/// whose name begins with "encoder", the antenna's angle; then the case's goals in its design wind
/// on it. Nothing of the case's friction and inertias enters; of its drive the oil spring where the
/// record does not give it, and the tachometer's lag. Without an encoder's column the case's
/// structure says how far the encoder's angle differs from the motor's, uncertain by a fifth of the
/// difference.
/// @throws InvalidInput for a record that the case has not or that was left out, one without valve
/// command or with the rate loop closed, a structure that is none; as make_campaign;
/// NumericalFailure where it is not coherent.
MeasuredTuneSection tune_measured(const io::Case& antenna, const MeasuredStudyOptions& options);

}  // namespace boresight::app
