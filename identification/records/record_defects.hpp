#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// Kinds of defects in a recorder's file.
enum class DefectKind {
  missing_samples,   // no number where one belongs
  missing_times,     // samples without a time
  repeated_times,    // the same time twice or more
  backward_times,    // a time before the one above
  jitter,            // times off an even grid
  rate_change,       // the sample rate changes within the record
  gap,               // a stretch of time without samples
  different_length,  // a channel with another number of samples than there are times
  clipped,           // flat at the largest or smallest value the recorder takes
  spike,             // one or two samples far off their neighbours
  stuck,             // a stretch of one value while others move
  dead_channel,      // one value, or hardly any other, while others move
  swapped_ports,     // a motor's inlet and outlet against those of the others
  reversed_sign,     // a channel against what drives it
  wrong_scale,       // a channel many times larger or smaller than in other records
  too_short          // fewer samples than any method takes
};
std::string to_string(DefectKind kind);

/// The handling of a defect.
enum class DefectHandling {
  reported,   // nothing
  left_out,   // samples or channel not used
  resampled,  // interpolated linearly onto an even grid
  bridged,    // filled from their neighbours
  masked,     // marked not valid, straight line between the neighbours
  replaced,   // by what other channels show
  refused     // the record is not used
};
std::string to_string(DefectHandling handling);

/// One defect of one channel of a record.
struct RecordDefect {
  DefectKind kind = DefectKind::missing_samples;
  DefectHandling handling = DefectHandling::reported;
  std::string channel;      // empty: the record as a whole
  Eigen::Index first = 0;   // sample of the file, from 0
  double first_time = 0.0;  // s, as recorded
  Eigen::Index count = 0;   // samples
  std::string explanation;  // a sentence
};

/// A channel as recorded, SI at the motor shaft.
struct RawChannel {
  std::string name;        // for defects, as the file calls it
  Eigen::VectorXd values;  // NaN: no number
  /// The recorder's limits for this channel.
  double upper_limit = std::numeric_limits<double>::infinity();
  double lower_limit = -std::numeric_limits<double>::infinity();
};

/// A record as recorded: arbitrary times, possibly incomplete.
struct RawRecord {
  std::string name;
  TestKind test = TestKind::other;
  /// True if the kind of test was stated; else recognised_test has to determine it.
  bool test_known = true;
  bool rate_loop_closed = false;
  Eigen::VectorXd time;                   // s, NaN: none
  std::vector<RawChannel> inlet, outlet;  // one a motor
  RawChannel tachometer;
  std::optional<RawChannel> rate_command, valve_command;
  std::optional<RawChannel> encoder;  // rad at the sky, continuous through full turns
};

struct DefectOptions {
  /// Records with fewer samples are refused.
  Eigen::Index fewest_samples = 200;
  /// A sample within this fraction of a stated limit counts as clipped.
  double limit_tolerance = 0.0015;
  /// Samples masked on either side of a clipped stretch, which the anti-alias filter has smeared.
  Eigen::Index guard_samples = 2;
  /// Times within this fraction of the sample time count as lying on the even grid.
  double jitter_tolerance = 0.02;
  /// Lost lines, at most three at a time, count as missing samples and are filled from their
  /// neighbours. clean_record sets it but for slosh tests.
  bool fill_short_gaps = false;
  /// A pressure that moves less than this fraction of the others' motion counts as dead.
  double dead_fraction = 0.02;
  /// Motors (from 0) whose ports are exchanged according to the campaign as a whole. Both pressures
  /// are replaced like dead ones (ColumnConflicts).
  std::vector<std::size_t> exchanged_motors;
  /// True if, according to the campaign as a whole, a command opposes the drive: it is left out.
  bool leave_out_rate_command = false;
  bool leave_out_valve_command = false;
};

/// Evidence against the names and signs of a record's columns.
struct ColumnSuspicions {
  /// Motors (from 0) whose pressure difference opposes that of the others.
  std::vector<std::size_t> exchanged_motors;
  bool rate_command = false;   // opposes the tachometer
  bool valve_command = false;  // opposes the tachometer
  bool torque = false;         // does work on the motion where friction takes power
};

/// A record without defects, or the reason for its refusal.
struct CleanRecord {
  std::optional<DriveRecord> record;
  /// Reason for the refusal, a sentence.
  std::string refusal;
  std::vector<RecordDefect> defects;
  ColumnSuspicions suspicions;
  /// True if the tachometer is dead, which only a slosh test tolerates. Not yet a reason for
  /// refusal if the test is still to be recognised.
  bool without_rate = false;
  /// Motors (from 0) whose inlet, outlet was replaced by the mean of the others'.
  std::vector<std::size_t> replaced_inlets, replaced_outlets;
};

/// Marks replaced pressures not valid throughout. An evaluation of each line on its own, such as a
/// slosh test, must not take the mean of the others for a line. No effect without a record.
void mask_replaced(CleanRecord& clean);

/// Finds the defects of a record and makes an evenly sampled one with what is not valid marked.
///
/// Times: samples without a time, with a time again or before an earlier one are left out (at most
/// one in twenty); an even grid, its step by least squares, takes the rest as they are if all are
/// within the tolerance (or within the digits the times have), else by linear interpolation between
/// valid neighbours. Where the times leave out more than three quarters of a step, the grid's
/// samples there are masked.
///
/// Channels: a sample at a stated limit, or in a run of eight or more equal ones at an extreme that
/// is four times as long as runs elsewhere, is clipped and masked with a guard band. A run of equal
/// samples, 25 or more and eight times as long as usual, while other channels move, is stuck:
/// masked. At most three missing samples in a row are filled by the cubic through their neighbours,
/// but in a slosh test, whose lines ring fast. One or two samples at least 12 times the local
/// differences off both sides are a spike: masked. A dead pressure is replaced by the mean of the
/// others at the same common line, valid where they all are: the sum over the motors is what
/// counts. In a slosh test it is masked (mask_replaced). A pressure far below zero most of the
/// time, which no oil has, counts as dead, and so does one that is clearly beyond its stated limit
/// in more than half of the record: its scale is wrong. Commands are taken as they are but for
/// missing samples; one that stands at one value while the drive moves by it (a valve command, or
/// the rate command of a closed rate loop) is left out, and so is an encoder that stands still
/// then. Other swapped or reversed channels are reported (ColumnSuspicions) and never turned: what
/// is to be done is for the campaign as a whole to say, column_conflicts.
///
/// Refused: too short, more than half of the samples of the tachometer (but in a slosh test) or of
/// all inlets or all outlets missing or dead, times of which more than one in twenty cannot be
/// used.
/// @throws InvalidInput for a record without inlets or with another number of outlets.
CleanRecord clean_record(const RawRecord& raw, const DefectOptions& options = {});

}  // namespace boresight::identification
