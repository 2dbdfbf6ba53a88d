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

/// A drive known by its measured response, and what its loops are judged in. The soft goal is the
/// rms of the beam as the channels have it: without a predicted bending the encoder's, for wind as
/// a torque at the motor shaft and with sensor noise.
struct MeasuredProblem {
  control::MeasuredChannels channels;
  double gear_ratio = 1.0;  // motor turns per antenna turn
  double delay = 0.0;       // s, on the valve command, beyond what the record has in it
  control::SensorNoise noise;
  WindCondition wind;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  int points_per_decade = 300;
};

/// Hard goals: for the measured response and for every one within its confidence.
struct MeasuredGoals {
  /// Largest |S| allowed at each break, in the order of control::loop_breaks.
  std::array<double, 3> sensitivity_peak{2.0, 2.0, 2.0};
  double valve_effort = 0.6;  // rad/s rms of noise-driven valve command
};

struct MeasuredTuningOptions {
  int starts = 20;
  std::uint64_t seed = 1;
  int evaluations_per_run = 150;
  int search_points_per_decade = 60;
  /// Probability, at any one frequency, that the true response lies in the circle that is judged; 0
  /// takes the measured response for the true one.
  double confidence = 0.95;
  /// At most so many times the least favourable responses are taken anew.
  int rounds = 12;
  /// Asked before every evaluation; true ends the search, what was found stands.
  std::function<bool()> stop;
};

enum class MeasuredTuningStatus {
  confident,   // goals met by every response within the confidence
  nominal,     // by the measured response only
  infeasible,  // by no law seen: the one nearest to the goals
  unstable,    // no stable law seen
};
std::string_view to_string(MeasuredTuningStatus status);

/// Highest sensitivity at a break.
struct MeasuredPeak {
  control::ResponsePeak measured;  // rad/s
  /// Over all responses within the confidence; infinite where they reach -1.
  control::ResponsePeak within_confidence;
  /// Where the latter is.
  control::ResponseBasis basis = control::ResponseBasis::measured;
};

/// Shares of a variance that come from frequencies where the response is not measured.
struct AssumedShare {
  double below = 0.0;       // the lowest usable point
  double encoder = 0.0;     // with tachometer and torque measured, the encoder's angle assumed
  double unresolved = 0.0;  // between usable points that do not resolve it
  double above = 0.0;       // the highest usable point
  double total() const { return below + encoder + unresolved + above; }
};

/// A law judged on the measured points alone, by other code than the tuner's.
struct MeasuredVerification {
  /// By control::margins(MeasuredLoop) at each break; unresolved intervals are in them.
  std::array<control::MeasuredMargins, 3> margins;
  /// Zeros of 1 + L in the right half plane by its angle followed from point to point, position
  /// loop open and closed. Below the points the drive's assumed behaviour is followed, above them L
  /// is assumed to stay below 1.
  std::array<int, 2> unstable{};
  /// Steps of that angle above 90 degrees: what happens within is not known. rad/s
  std::vector<control::PointBand> open_steps;
  /// |L| at the highest point, position loop open and closed: a resonance beyond it that raises the
  /// response by more than 1/|L| is not judged here.
  std::array<double, 2> gain_at_highest{};
  /// Largest of radius times relative error of S over frequencies and breaks. Below 1 every
  /// response within the confidence has the winding of the measured one.
  double largest_error = 0.0;
  std::array<MeasuredPeak, 3> peaks;
  bool passed = false;
  std::string failure;  // why not
};

struct MeasuredTuningResult {
  MeasuredTuningStatus status = MeasuredTuningStatus::unstable;
  control::ControlLaw law;
  control::LoopEvaluation evaluation;  // on the measured response
  MeasuredVerification verification;
  double rms = 0.0;  // rad of motor, encoder (or beam where bending is predicted)
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double valve_effort = 0.0;  // rad/s
  AssumedShare wind_share, noise_share, effort_share;
  /// d ln rms/d ln of the oil spring's stiffness and loss rate, gains held: how the rms stands on
  /// what the test does not measure.
  double by_stiffness = 0.0;
  double by_loss_rate = 0.0;
  double confidence = 0.0;
  double radius = 0.0;  // of the confidence, standard deviations
  /// Rms of the best law for the measured response alone, rad of motor: what the confidence costs.
  double nominal_rms = 0.0;
  std::vector<std::string> active_goals;
  std::vector<std::string> gains_at_bound;
  int starts = 0;
  int starts_at_optimum = 0;  // rms within 1 % of the best on the search's grid
  int rounds = 0;
  long evaluations = 0;
  bool stopped = false;  // by options.stop
};

/// Frequencies (rad/s) over which a measured problem is judged: a logarithmic grid from the lower
/// of 1e-4 Hz and the rms band's edge to the higher of 25 Hz, its edge and four times the highest
/// measured frequency, with edges and, if `with_points`, all usable points.
Eigen::ArrayXd measured_grid(const MeasuredProblem& problem, int points_per_decade,
                             bool with_points);

/// The measured problem ready to evaluate control laws.
control::LoopEvaluator make_evaluator(const MeasuredProblem& problem);

/// Least rms under the hard goals on a measured response: FeasibleSearch on the logarithms of the
/// gains from seeded log-uniform starts on a coarse grid, the best few again on the problem's own;
/// then with the least favourable responses within the confidence (control::least_favourable at
/// each break) as members that must meet the peaks too, taken anew until the law no longer changes
/// them. Deterministic by seed.
/// @throws InvalidInput for options below 1, goals that are not above 1 (effort: above 0), a
/// confidence outside 0 to 1.
MeasuredTuningResult tune(const MeasuredProblem& problem, const control::LoopStructure& structure,
                          const MeasuredGoals& goals, const MeasuredTuningOptions& options = {});

/// `radius`: control::confidence_radius.
MeasuredVerification verify(const MeasuredProblem& problem, const control::ControlLaw& law,
                            const MeasuredGoals& goals, double radius);

}  // namespace boresight::design
