#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/control/measured/measured_channels.hpp>
#include <boresight/control/measured/measured_loop.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// A drive known by its measured response, and the conditions its loops are evaluated in. The
/// objective is the boresight rms by the channels, with wind as a torque at the motor shaft and
/// with sensor noise. Without predicted flexure it is the rms at the encoder.
struct MeasuredProblem {
  control::MeasuredChannels channels;
  double gear_ratio = 1.0;  // motor turns per antenna turn
  double delay = 0.0;       // s, on the valve command, in addition to the record's own
  control::SensorNoise noise;
  WindCondition wind;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  int points_per_decade = 300;
};

/// Constraints, for the measured response and for every response within its confidence region.
struct MeasuredConstraints {
  /// Largest |S| allowed (Ms) at each break, in the order of control::loop_breaks.
  std::array<double, 3> sensitivity_peak{2.0, 2.0, 2.0};
  double control_effort = 0.6;  // rad/s rms of noise-driven valve command
};

struct MeasuredTuningOptions {
  int starts = 20;
  std::uint64_t seed = 1;
  int evaluations_per_run = 150;
  int search_points_per_decade = 60;
  /// Probability, at any one frequency, that the true response lies within the evaluated circle. 0:
  /// the measured response is taken as exact.
  double confidence = 0.95;
  /// Largest number of updates of the least favourable responses.
  int rounds = 12;
  /// Polled before every evaluation. True ends the search; results so far are kept.
  std::function<bool()> stop;
};

enum class MeasuredTuningStatus {
  confident,   // constraints met by every response within the confidence region
  nominal,     // constraints met by the measured response only
  infeasible,  // no controller found; the result is the nearest one
  unstable,    // no stable controller found
};
std::string_view to_string(MeasuredTuningStatus status);

/// Maximum sensitivity Ms at a break.
struct MeasuredPeak {
  control::ResponsePeak measured;  // rad/s
  /// Over all responses within the confidence region; infinite if the region reaches -1.
  control::ResponsePeak within_confidence;
  /// Basis of the response at the frequency of `within_confidence`.
  control::ResponseBasis basis = control::ResponseBasis::measured;
};

/// Fractions of a variance that come from frequencies where the response is not measured.
struct AssumedFraction {
  double below = 0.0;       // below the lowest usable point
  double encoder = 0.0;     // tachometer and torque measured, encoder angle assumed
  double unresolved = 0.0;  // between usable points that do not resolve it
  double above = 0.0;       // above the highest usable point
  double total() const { return below + encoder + unresolved + above; }
};

/// Check of a controller on the measured points alone, by code independent of the tuner.
struct MeasuredVerification {
  /// By control::margins(MeasuredLoop) at each break; unresolved intervals are included.
  std::array<control::MeasuredMargins, 3> margins;
  /// Number of zeros of 1 + L in the right half plane, with position loop open and closed. Computed
  /// from the phase of 1 + L followed from point to point. The drive's assumed behaviour is used
  /// below the points; above them |L| is assumed to stay below 1.
  std::array<int, 2> unstable{};
  /// Intervals (rad/s) over which that phase changes by more than 90 degrees; the response inside
  /// them is unknown.
  std::vector<control::PointBand> open_steps;
  /// L| at the highest point, position loop open and closed. Resonances beyond that point which
  /// amplify the response by more than 1/|L| are not covered by this check.
  std::array<double, 2> gain_at_highest{};
  /// Largest product of radius and relative error of S, over frequencies and breaks. Below 1, every
  /// response within the confidence region has the Nyquist encirclements of the measured one.
  double largest_error = 0.0;
  std::array<MeasuredPeak, 3> peaks;
  bool passed = false;
  std::string failure;  // reason; empty if passed
};

struct MeasuredTuningResult {
  MeasuredTuningStatus status = MeasuredTuningStatus::unstable;
  control::Controller controller;
  control::LoopEvaluation evaluation;  // on the measured response
  MeasuredVerification verification;
  double rms = 0.0;  // rad of motor, at encoder (or boresight with predicted flexure)
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double control_effort = 0.0;  // rad/s
  AssumedFraction wind_fraction, noise_fraction, effort_fraction;
  /// d ln rms / d ln of the oil spring's stiffness and of its loss rate, gains fixed. They give the
  /// sensitivity of the rms to parameters that the test does not measure.
  double by_stiffness = 0.0;
  double by_loss_rate = 0.0;
  double confidence = 0.0;
  double radius = 0.0;  // of the confidence, standard deviations
  /// Rms (rad of motor) of the best controller for the measured response alone. The difference from
  /// `rms` is the cost of the confidence.
  double nominal_rms = 0.0;
  std::vector<std::string> active_constraints;
  std::vector<std::string> gains_at_bound;
  int starts = 0;
  int starts_at_optimum = 0;  // rms within 1 % of the best on the search's grid
  int rounds = 0;
  long evaluations = 0;
  bool stopped = false;  // by options.stop
};

/// Frequency grid (rad/s) for the evaluation of a measured problem, logarithmic. It starts at the
/// lower of 1e-4 Hz and the rms band's lower edge. It ends at the highest of 25 Hz, the band's
/// upper edge and four times the highest measured frequency. The band edges are included, and all
/// usable points if `with_points`.
Eigen::ArrayXd measured_grid(const MeasuredProblem& problem, int points_per_decade,
                             bool with_points);

/// Evaluator of controllers on the measured problem.
control::LoopEvaluator make_evaluator(const MeasuredProblem& problem);

/// Minimises the rms under the constraints on a measured response. FeasibleSearch works on the
/// logarithms of the gains from seeded log-uniform starts on a coarse grid. The best few are
/// refined on the problem's own grid. The least favourable responses within the confidence region
/// (control::least_favourable at each break) then become members that must meet the peak limits.
/// They are updated until the controller no longer changes them. Deterministic by seed.
/// @throws InvalidInput for a conditional integral, options below 1, limits that are not above 1
/// (effort: above 0), or a
/// confidence outside 0 to 1.
MeasuredTuningResult tune(const MeasuredProblem& problem, const control::LoopStructure& structure,
                          const MeasuredConstraints& goals,
                          const MeasuredTuningOptions& options = {});

/// Checks a controller on the measured points. `radius` as returned by control::confidence_radius.
MeasuredVerification verify(const MeasuredProblem& problem, const control::Controller& controller,
                            const MeasuredConstraints& goals, double radius);

}  // namespace boresight::design
