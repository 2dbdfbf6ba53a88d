#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/records/column_conflicts.hpp>
#include <boresight/identification/records/drive_record.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// What must be known of a channel: recorded = gain * true + zero, `delay` later.
enum class ChannelQuantity {
  gain,   // 1 if right
  sign,   // a gain that is certainly negative
  zero,   // 0 if right
  delay,  // s, 0 if right
};
/// "gain", "sign", "zero", "delay".
std::string to_string(ChannelQuantity quantity);

enum class ChannelVerdict {
  right,           // 1 (of a zero or delay: 0) is within `suspect_beyond` standard uncertainties
  suspect,         // it is not
  undeterminable,  // these records do not bound the quantity
};
/// "right", "suspect", "undeterminable".
std::string to_string(ChannelVerdict verdict);

/// The likely reason for a gain.
struct LikelyFactor {
  double factor = 1.0;  // recorded over true
  std::string name;     // "10", "1/0.9", "psi read as kPa"; empty: the measured factor itself
};

/// One quantity of one channel, as it must be for the other channels to be right.
struct ChannelCheck {
  enum class Channel { tachometer, inlet, outlet, torque };
  Channel channel = Channel::tachometer;
  std::size_t motor = 0;  // from 0; of a pressure or torque
  /// As the files call it; of a torque both of its pressures, "p1_in - p1_out".
  std::string name;
  std::string record;  // empty: all records
  ChannelQuantity quantity = ChannelQuantity::gain;
  std::string unit;     // SI
  std::string against;  // what it was compared with
  /// Nothing where these records cannot give it. Errors of the estimate and real differences
  /// between motors, not the instruments' stated accuracy.
  std::optional<numerics::Interval> interval;
  /// Standard uncertainty that the instruments' stated accuracy, own and others', makes of it.
  double stated_uncertainty = 0.0;
  ChannelVerdict verdict = ChannelVerdict::undeterminable;
  std::optional<LikelyFactor> likely;  // of a gain that is suspect
  /// The channel's own values enter the methods: false where they are replaced by other motors'.
  bool is_used = true;
};

struct ChannelConsistencyOptions {
  /// Standard uncertainties, of estimate and stated accuracy together, from which a quantity is
  /// suspect: of the some 25 quantities of a campaign without faults one is beyond it in about one
  /// campaign of a hundred.
  double suspect_beyond = 3.5;
  /// Means of pressures over so long are compared, s: longer than lines ring.
  double pressure_block = 0.2;
  /// Changes of the encoder's and the integrated tachometer's means over so long are compared, s.
  double motion_block = 1.0;
  /// Blocks are halved down to this, s, where a record has too few of them.
  double shortest_motion_block = 0.125;
  /// A gain whose 95 % interval is wider than +- this, relative, is not determined.
  double widest_gain = 0.1;
  /// The same of a pressure's zero, in parts of the supply pressure; of the tachometer's, in parts
  /// of its fastest rate.
  double widest_zero = 0.05;
  double widest_delay = 0.2;  // s
  /// Height between the motors' transducers, standard deviation, m: the oil between adds to the
  /// lower one.
  double height = 0.5;
  /// Of the tachometer's zero, in parts of its fastest rate: no accuracy of it is stated.
  double tachometer_zero = 0.005;
  /// Standard deviation of the tachometer's delay by its filter beside a sample interval, s.
  double filter_delay = 0.01;
};

/// What each channel's gain, zero, sign and delay must be for the others to be right.
///
/// Tachometer against the encoder (where recorded): the encoder's change, in turns of the motor,
/// against that of the integrated tachometer, from one mean to the next:
///   N dtheta = (1/G) dphi - (z/G) T + c dtorque + (d/G) drate,
/// G gain, z zero, d delay, T the time between; c, the flexibility of gear train and structure, is
/// fitted along, so that wind-up counts as no error. N (gear_ratio) is taken as exact. Slosh tests
/// are left out.
///
/// Each motor's pressure against the mean of the other motors' at the same common line, both over
/// pressure_block:  p = G r + z + a w + b w |w| + c dw/dt,
/// w the motor rate: what the pressure differs with the flow, as unlike losses and masses of oil in
/// the lines make it, is fitted along and counts as no error. The allowance for unlike heights is
/// density g height. The reference's noise (noise_level) is accounted for. Slosh tests are left
/// out: each line rings. The torque of each motor (torque_per_pressure times the difference of its
/// ports) against the mean of the others', to which the gear train couples it, in the same way.
///
/// A channel that is suspect is no reference for others: the one that is furthest off is left out,
/// and the others are compared again. With two motors both are suspect, as nothing tells which. A
/// record in which a channel is unlike the other records by more than the stated accuracy has a row
/// of its own and is left out of that of all records.
///
/// Likely factors are 10, 0.1, 0.9, 1/0.9, of pressures also units of kPa and bar read as psi and
/// the reverse, -1 (reversed) and, of a pressure that falls from its mean as the others rise,
/// exchanged ports; taken where they are within 1 % or two standard uncertainties.
///
/// Not told: a scale that all motors' pressures share, the displacement, the encoder's scale and
/// gear ratio (a wrong one shows as the tachometer's gain), one motor's pressures without others'.
/// Intervals by Student's t of grouped_regression. `records`: those of a campaign, raw and cleaned;
/// `instruments` as stated.
std::vector<ChannelCheck> channel_consistency(const std::vector<EvaluatedRecord>& records,
                                              const DriveKnowledge& knowledge,
                                              const Instruments& instruments,
                                              const ChannelConsistencyOptions& options = {});

}  // namespace boresight::identification
