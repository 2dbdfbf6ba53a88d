#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/commissioning/commissioning_records.hpp>
#include <boresight/design/commissioning/ratio_band.hpp>
#include <boresight/design/commissioning/wind_error_fit.hpp>
#include <boresight/identification/records/drive_record.hpp>

namespace boresight::design {

/// A record of an error in measured wind.
struct WindyRecord {
  std::string name;
  double sample_time = 0.0;           // s
  identification::Signal error;       // rad
  identification::Signal wind_speed;  // m/s, as many samples
  /// rad, as many samples or absent.
  std::optional<identification::Signal> wind_direction;
};

/// Factor between wind speeds that count as equal in the ranges of two conditions.
inline constexpr double equal_wind_range = 1.05;

struct WindComparisonOptions {
  double confidence = 0.95;
  /// m/s; absent: the median of the records' mean speeds where both conditions have records.
  std::optional<double> reference_speed = {};
  /// m/s; absent: not compared at another speed.
  std::optional<double> design_speed = {};
  /// s: segments of the spectra are at most this long. The comparison is of frequencies above 1.5
  /// over the segment, so that slow drift is no part of it.
  double longest_segment = 100.0;
};

/// One record in numbers.
struct WindyRecordFigures {
  std::string name;
  double duration = 0.0;        // s
  double mean_speed = 0.0;      // m/s
  double wind_intensity = 0.0;  // standard deviation of the wind speed over its mean
  double rms = 0.0;             // rad, of the error in the band
  double freedom = 0.0;         // equivalent degrees of freedom of its square
  /// Logarithm of the variance of the gusts over what the records have on average at that speed.
  double log_gusts = 0.0;
};

/// The records of one condition.
struct ConditionInWind {
  std::vector<WindyRecordFigures> records;
  double slowest = 0.0, fastest = 0.0;  // m/s, of the mean speeds
  /// Fraction of the error's power that is coherent with the square of the measured wind speed, and
  /// the fraction that records without any coherence exceed in one case of twenty.
  double explained = 0.0, explained_threshold = 0.0;
  /// rad, circular mean of the wind direction; absent if no record has it.
  std::optional<double> wind_direction;
};

/// Both conditions at one wind speed.
struct RatioAtSpeed {
  double speed = 0.0;     // m/s
  RmsBand before, after;  // rad
  RatioBand ratio;        // of rms, after over before
  Change change = Change::none;
  /// True if the condition has no record in as weak or as strong a wind: extrapolated.
  bool before_extrapolated = false, after_extrapolated = false;
};

/// How the comparison was made, or why it was not.
enum class WindComparisonKind {
  regression,       // at equal wind, by the variance of the error against the wind speed
  equal_wind,       // too few records for that, all in the same wind: by Fisher's F
  no_overlap,       // none: the conditions' wind speeds have no range in common
  too_few_records,  // none: fewer than three of a condition, in different winds
};
std::string_view to_string(WindComparisonKind kind);

struct WindComparison {
  WindComparisonKind kind = WindComparisonKind::no_overlap;
  double lowest = 0.0, highest = 0.0;  // Hz, of all rms
  ConditionInWind before, after;
  /// Absent if not compared.
  std::optional<RatioAtSpeed> at_reference;
  /// By regression only.
  std::optional<RatioAtSpeed> at_design;
  /// Ratio of the rms of the parts of the error that are coherent with the wind, in the same wind.
  /// Absent unless both conditions have three records there and significant coherence.
  std::optional<RatioBand> by_coherence;
  /// Of the regression: exponent of the wind speed, of the gusts.
  double exponent = 0.0, gust_exponent = 0.0;
  /// Wind directions differ by more than 30 deg: the torque coefficient depends on attitude.
  bool directions_differ = false;
};

/// Compares the rms of an error before and after a change of the controller at equal wind.
///
/// Spectra are by P. D. Welch's method, with segments of an eighth of the shortest record or
/// `longest_segment` under Hann's window, a straight line removed from each; segments with invalid
/// samples are left out. The rms covers the band from 1.5 over the segment to the lowest of the
/// half sampling rates. Wind speeds of a record count by their mean.
///
/// Regression, with three records or more of each condition: WindErrorFit. Its gusts are the
/// variance of the squared wind speed, to which the torque is proportional, in the band that holds
/// the middle 90 % of the errors' power; what is usual is a power of the mean speed fitted to all
/// records. In simulation the variance of the error is proportional neither to the fourth power of
/// the speed nor to that variance: between records of one controller of the 70-m antenna at 4 to 9
/// m/s and others at 7 to 13 m/s, such regressions find changes of 16 and 5 % that there are not.
///
/// Coherence: with the spectra of all records of a condition added up, H = S_we/S_ww is the
/// response from the squared wind speed to the error, and |H|^2 S_ww the coherent part of the
/// error's spectrum. The squared coherence is reduced by its bias for n averages, (1 -
/// coherence)/(n - 1) (J. S. Bendat, A. G. Piersol, Random Data, 4th ed., 9.2). `by_coherence` is
/// of the records whose mean speed both conditions have, as the coherence of mast and dish depends
/// on it. It takes both H in the mean spectrum of the wind of all of them; its interval is by the
/// jackknife over records, with Student's t. This evidence does not depend on the regression, and
/// is of the slow gusts alone that mast and dish have in common: a controller may be better against
/// these and worse otherwise.
///
/// Wind speeds within equal_wind_range count as equal, in the ranges of the conditions. Those of
/// `equal_wind` differ by at most 10 %. There each variance is scaled to the reference wind by
/// usual_wind_exponent, and the interval of Fisher's F is widened by what is not known of that
/// exponent and by the scatter of records in the same mean wind, 10 % of an rms each.
/// @throws InvalidInput for a condition without records, signals of different lengths, values that
/// are not finite, fewer than 256 samples, wind speeds that are not positive on average, a constant
/// error, a record without a segment of valid samples, and options out of range.
WindComparison compare_in_wind(const std::vector<WindyRecord>& before,
                               const std::vector<WindyRecord>& after,
                               const WindComparisonOptions& options = {});

}  // namespace boresight::design
