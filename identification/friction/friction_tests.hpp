#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/records/instrument_errors.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

struct FrictionTestOptions {
  /// A tail counts as settled if rate and torque change between its two halves by less than this
  /// fraction.
  double settled_fraction = 0.03;
  /// Tail lengths as fractions of a half period, measured from its end: the longest one tried, and
  /// the one used if none is settled.
  double longest_tail = 0.8;
  double unsettled_tail = 0.4;
  double guard_time = 0.1;  // s about clipped or missing samples
  /// True: subtract the inertia times each tail's acceleration, as a weak rate loop never quite
  /// settles. False: use the mean torque (Sommerville).
  bool subtract_inertia = true;
  /// Time after breakaway over which the slow ramp's torque is averaged, s.
  double after_breakaway = 0.25;
  /// The antenna is at rest if its rate stays for `rest_time` (s) below this fraction of the
  /// record's largest rate, or below five standard deviations of the tachometer noise.
  double rest_fraction = 0.1;
  double rest_time = 0.3;
  int random_samples = 400;  // of the Monte Carlo
  std::uint64_t seed = 1;
};

/// Half periods of a bipolar wave: from the sample at which it passes half its level (the 90th
/// percentile of its size) to the one before it passes that level's negative. Those shorter than
/// half the longest are left out, as is rest before the first.
struct HalfPeriod {
  Eigen::Index first = 0;
  Eigen::Index last = 0;  // included
  int direction = 0;      // +1, -1
};
std::vector<HalfPeriod> half_periods(const Eigen::VectorXd& wave);

/// Settled end of one half period.
struct SteadyTail {
  std::size_t record = 0;  // of the campaign
  HalfPeriod samples;
  double rate = 0.0;                // mean, rad/s
  double torque = 0.0;              // mean, N m
  double torque_uncertainty = 0.0;  // standard, by the samples' autocorrelation
  double acceleration = 0.0;        // rad/s2, mean
  bool settled = true;
  Eigen::VectorXd mean_pressure;  // Pa, inlets then outlets
};

/// One speed: mean of up and down.
struct ConstantSpeedPoint {
  std::size_t record = 0;
  double rate = 0.0;           // rad/s
  numerics::Interval coulomb;  // N m, half the difference of the torques up and down
  numerics::Interval offset;   // N m, half their sum
  /// Torque (N m) of the inertia removed from the half difference: small if the test has settled.
  double inertia_torque = 0.0;
  std::size_t tails = 0;
  std::size_t unsettled = 0;
};

/// Changes of a straight friction line and its offset in each sample, in the order of the samples.
struct LineSamples {
  Eigen::VectorXd intercept;  // N m
  Eigen::VectorXd slope;      // N m s/rad
  Eigen::VectorXd offset;     // N m
};

struct ConstantSpeedTests {
  std::vector<SteadyTail> tails;
  std::vector<ConstantSpeedPoint> points;  // by rate
  /// Line through the points, Sommerville section IV.B.1. Exact for two points, least squares for
  /// more. Only with at least two speeds.
  bool has_line = false;
  numerics::Interval slope;      // N m s/rad
  numerics::Interval intercept;  // N m, "Coulomb friction"
  double line_misfit = 0.0;      // N m, the largest distance of a point
  numerics::Interval offset;     // N m, mean over the speeds
  /// Of the pressure transducers' errors alone, and of the tails' scatter alone.
  LineSamples by_transducers;
  LineSamples by_scatter;
  std::vector<std::string> notes;
};

/// Friction by constant-speed tests (Sommerville section IV.B.1): each speed, and the straight
/// line. Half periods follow the rate command, or the tachometer without one. Intervals by Monte
/// Carlo over the instruments, the tails' scatter, displacement and torque efficiency. `inertia`
/// (kg m2): for the torque of the tails' acceleration, which is reported and subtracted.
/// @throws NumericalFailure if no constant-speed test has usable half periods in both directions.
ConstantSpeedTests constant_speed_tests(const Campaign& campaign,
                                        const numerics::Uncertain& inertia,
                                        const FrictionTestOptions& options = {});

/// One start from rest in a slow ramp.
struct Breakaway {
  std::size_t record = 0;
  Eigen::Index sample = 0;         // where the rate leaves rest
  int direction = 0;               // +1, -1
  double torque = 0.0;             // N m as motion begins
  double torque_after = 0.0;       // N m, mean just after
  Eigen::VectorXd pressure;        // Pa, means as motion begins
  Eigen::VectorXd pressure_after;  // Pa, means just after
};

struct SlowRampTests {
  std::vector<Breakaway> breakaways;
  numerics::Interval breakaway;  // N m, as motion begins: half the difference of up and down
  numerics::Interval coulomb;    // N m, just after
  numerics::Interval offset;     // N m, half the sum just after
  /// Intercept and offset as above; slope 0.
  LineSamples by_transducers;
  LineSamples by_scatter;
  std::vector<std::string> notes;
};

/// Breakaway and "Coulomb" friction by slow ramps (Sommerville section IV.B.2).
/// @throws NumericalFailure if no slow ramp starts from rest in both directions.
SlowRampTests slow_ramp_tests(const Campaign& campaign, const FrictionTestOptions& options = {});

/// Standard uncertainty of a series' mean with its samples' correlation: the sum of autocovariances
/// up to the first that is negative (J. Geyer, Statistical Science 7, 1992, in its simplest form).
double mean_uncertainty(const Eigen::VectorXd& series);

}  // namespace boresight::identification
