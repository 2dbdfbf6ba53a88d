#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/commissioning/wind_comparison.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/identification/records/servo_record.hpp>

namespace boresight::design {

/// The error by which records are compared.
enum class RecordedError {
  boresight,  // of the beam
  position,   // position command less encoder
};
std::string_view to_string(RecordedError error);

/// Records of both conditions with one kind of error.
struct ChangeRecords {
  RecordedError error = RecordedError::boresight;
  std::vector<WindyRecord> before, after;
};

/// The boresight errors if all records have them, else the position errors. `speed_ratio`: mean
/// wind speed at the dish over that measured (plant::WindMast).
/// @throws InvalidInput naming the record without the error that the others have, or without wind
/// speed.
ChangeRecords change_records(const std::vector<identification::ServoRecord>& before,
                             const std::vector<identification::ServoRecord>& after,
                             double speed_ratio = 1.0);

/// The rms that the linear model predicts in the band and at the reference wind of a comparison.
struct PredictedChange {
  double rms_before = 0.0, rms_after = 0.0;  // rad at the sky, on the mission's own plant
  /// Its interval is over the plants of the ensemble on which both loops are stable.
  RatioBand ratio;
  std::size_t plants = 0;  // of them
  /// True if measured interval and prediction overlap.
  bool held = false;
};

/// A condition for the change to stay.
enum class ChangeCheckKind {
  wind_overlap,     // both conditions were recorded in the same range of wind speed
  wind_direction,   // and in similar wind directions; unknown if not recorded
  improvement,      // the error is significantly smaller than before
  prediction,       // the measured and predicted ratios agree; unknown without a prediction
  stability,        // the new controller is stable on the mission's plant and every ensemble member
  design_wind_rms,  // at the design wind the upper limit of the boresight error's rms is within the
                    // tightest budget; unknown if extrapolated, of position errors, or if the
                    // mission has no budget
};

struct ChangeCheck {
  ChangeCheckKind kind = ChangeCheckKind::wind_overlap;
  std::optional<bool> passed;  // unknown: it could not be checked
};

/// What records show of a change of the controller.
struct ChangeStudy {
  RecordedError error = RecordedError::boresight;
  WindComparison comparison;
  double design_speed = 0.0;     // m/s
  std::optional<double> budget;  // rad, the mission's tightest
  /// Absent without a controller before, without a comparison, or where a loop is unstable on the
  /// mission's plant.
  std::optional<PredictedChange> predicted;
  bool stable_nominal = false;    // the controller after on the mission's own plant
  std::size_t plants = 0;         // of the ensemble
  std::size_t stable_plants = 0;  // with the controller after
  std::vector<ChangeCheck> checks;
};

struct ChangeOptions {
  std::optional<double> reference_speed = {};  // m/s, see WindComparisonOptions
  double confidence = 0.95;
  unsigned threads = 1;
};

/// Compares the records at equal wind and the result with the prediction for the two controllers.
/// The prediction is of the linear loop with a rational dead time, in the wind model of the mission
/// at the speed of the comparison, with sensor noise; the position error includes the encoder's own
/// noise. Does not depend on the number of threads.
/// @throws InvalidInput as compare_in_wind.
ChangeStudy study_change(const Mission& mission, const PlantEnsemble& ensemble,
                         const ChangeRecords& records,
                         const std::optional<control::Controller>& before,
                         const control::Controller& after, const ChangeOptions& options = {});

/// Rms (rad at the sky) of an error between two frequencies (Hz) at a mean wind speed (m/s), on the
/// problem's plant. NaN if the loop is unstable.
double predicted_rms(const TrackingProblem& problem, const control::Controller& controller,
                     RecordedError error, double speed, const control::FrequencyBand& band);

}  // namespace boresight::design
