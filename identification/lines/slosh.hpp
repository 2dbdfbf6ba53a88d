#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

enum class LineSide { inlet, outlet };

/// A time at which the lines begin to ring.
struct SloshEvent {
  double time = 0.0;           // s from the record's first sample
  double ringing_ratio = 0.0;  // rms in the lines' band just after over just before
  bool closing = false;        // the drive came to rest after it: the valve closed
};

/// The first half-wave mode of one line, valve to one port of a motor.
struct LineRinging {
  std::size_t motor = 0;  // from 0, as the record's pressures
  LineSide side = LineSide::inlet;
  numerics::Interval frequency;  // undamped natural, Hz
  numerics::Interval damping_ratio;
  std::size_t events = 0;  // that it rests on
  /// Standard deviation between the events beyond each fit's own uncertainty, Hz.
  double between_events = 0.0;
  std::optional<numerics::Uncertain> length;       // m; nothing where no drawing gives this line's
  std::optional<numerics::Interval> wave_speed;    // m/s, 2 L f
  std::optional<numerics::Interval> bulk_modulus;  // Pa, (2 L f)^2 rho
};

/// A port's amplitude spectrum after one event and what was fitted there: a plot's data.
struct RingingPlot {
  std::size_t motor = 0;
  LineSide side = LineSide::inlet;
  double start = 0.0;         // s, of the window
  Eigen::VectorXd pressure;   // Pa, less slow part and cross-talk; sampled as the record
  Eigen::VectorXd fitted;     // Pa, the same
  Eigen::VectorXd frequency;  // Hz
  Eigen::VectorXd amplitude;  // Pa, of the pressure
  Eigen::VectorXd fitted_amplitude;
};

struct SloshOptions {
  /// Pa: oil with air to oil with next to none. With the lengths they bound the search.
  double lowest_bulk_modulus = 0.5e9;
  double highest_bulk_modulus = 2.3e9;
  /// Hz, where no length is known.
  double lowest_frequency = 15.0;
  double highest_frequency = 150.0;
  /// Ratio of ringing after to before that defines an event.
  double min_ringing_ratio = 1.6;
  /// The fit begins this many periods of the band's centre after an event, when the valve has
  /// stopped, ...
  double settling_periods = 2.5;
  /// ... and lasts this many time constants of the ringing, but no more than this (s).
  double time_constants = 4.0;
  double longest_window = 1.2;
  double largest_damping_ratio = 0.1;
  /// Fraction of samples of a window that may be invalid.
  double invalid_fraction = 0.02;
};

/// Sommerville's assignment (section III.A): of all ports' frequencies the highest belongs to the
/// shortest line and the lowest to the longest.
struct ExtremeLines {
  double highest_frequency = 0.0;  // Hz
  double lowest_frequency = 0.0;
  numerics::Interval bulk_modulus_shortest;  // Pa
  numerics::Interval bulk_modulus_longest;
  numerics::Interval mean;
};

struct SloshResult {
  std::vector<SloshEvent> events;
  std::vector<LineRinging> lines;  // by motor, inlet before outlet; those that rang
  std::optional<ExtremeLines> extreme_lines;
  /// Pooled over all lines of known length. The density is a common error of all lines, the length
  /// one of a motor's two lines.
  std::optional<numerics::Interval> bulk_modulus;  // Pa
  std::optional<numerics::Interval> wave_speed;    // m/s
  std::vector<std::string> notes;  // what was found, assumed or left out, with numbers
  std::vector<RingingPlot> plots;  // of the strongest event
};

/// Bulk modulus of the oil from a slosh test. Finds the times at which the valve opened or closed
/// from the pressures alone. Fits a damped cosine to each port's ringing after each of them,
/// together with the other lines' cross-talk. Computes from frequency, length and density the wave
/// speed c = 2 L f and beta = rho c^2 of each line (a half wave: Sommerville eqs. 21-26).
///
/// Lengths: one per motor (inlet and outlet alike). With fewer, the first and the last belong to
/// the highest and the lowest frequency; a single one applies to every line. Without any, only
/// frequencies are returned. The interval of a bulk modulus includes length, density, the fits'
/// uncertainties and the scatter between events; the pooled one also includes the scatter between
/// lines.
///
/// @throws InvalidInput for a record without pressures or sampled below four times the band's lower
/// end; NumericalFailure if no line rings, stating what was searched for.
SloshResult identify_slosh(const DriveRecord& record, const DriveKnowledge& knowledge,
                           const SloshOptions& options = {});

/// The events of identify_slosh, in order: rises of the energy between `lowest` and `highest` (Hz)
/// of all port pressures together.
std::vector<SloshEvent> slosh_events(const DriveRecord& record, double lowest, double highest,
                                     const SloshOptions& options = {});

}  // namespace boresight::identification
