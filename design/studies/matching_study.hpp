#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/matching/flat_range.hpp>
#include <boresight/design/matching/matching_curves.hpp>
#include <boresight/design/matching/matching_smoothness.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/studies/tuning_study.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {

/// One motor inertia of the study, and what does not depend on the loops. SI, at the motor shaft
/// where nothing else is said.
struct MatchPoint {
  double disks = 0.0;                // on each motor
  bool unit_ratio = false;           // motors as heavy as gear train and antenna
  bool as_built = false;             // the mission's own motors
  bool on_grid = true;               // of evenly spaced numbers of disks
  double motor_inertia = 0.0;        // kg m2, of all motors
  double motor_to_load_ratio = 0.0;  // R: motors over gear train and antenna
  double reflected_inertia = 0.0;    // kg m2, of all
  plant::PlantMode hydraulic = {};
  plant::PlantMode oil_mode = {};  // plant::mode_of_oil
  /// rad/s2 at the sky, at the slew rate: what the drive has reserve for there
  /// (design::within_reach); without Antenna::nonlinear what the supply's torque leaves beyond
  /// friction, the valve's drop not counted. 0 or less where nothing is left.
  double acceleration = 0.0;
  double slew_time = 0.0;  // s for slew_distance at the slew rate; infinite without acceleration
  double two_mass_damping = 0.0;  // the rule zeta = 1/2 sqrt(J_L/J_m)
  /// Acceleration for given torque over the most that any gear ratio gives with these motors:
  /// 2 sqrt(R)/(1 + R).
  double acceleration_of_best_ratio = 0.0;
};

/// A controller on the nonlinear antenna: in still air, at rest and at the tracking rate, and in
/// wind.
struct MatchTimeDomain {
  std::vector<HuntingResult> hunting;
  std::optional<ReversalResult> reversal;
  /// Over several records of wind; none of one not free of limit cycles beyond the tightest budget.
  std::optional<SimulatedRms> expected = std::nullopt;
  /// Linear, root mean square over the ensemble with these motors (rms_over_members), without one
  /// of the mission's plant (rad at the sky); NaN where `expected` is none.
  double member_rms = std::numeric_limits<double>::quiet_NaN();
};

/// One law of the study on the mission's plant. Angles at the sky, one axis.
struct MatchValue {
  bool found = false;  // a law that holds its goals on every plant
  double beam_rms = 0.0, wind_rms = 0.0, noise_rms = 0.0;  // rad
  double valve_effort = 0.0;                               // rad/s, by noise
  /// Mean wind and crest factor times the gusts.
  double gust_demand = 0.0;  // rad/s of valve
  double gust_torque = 0.0;  // N m
  std::array<control::Margins, 3> margins;
  double bandwidth = 0.0;  // Hz: the lowest at which the position loop's |S| reaches 1/sqrt(2)
  /// rad per rad/s2: steady error under a constant acceleration that is not fed forward, 1/(w^2 L)
  /// of the position loop as w goes to 0.
  double acceleration_error = 0.0;
  Verification verification;
  std::optional<MatchTimeDomain> time_domain;
};

/// One structure over all points.
struct MatchSeries {
  std::string name;  // as the user names it
  MatchingCurve curve;
  std::vector<MatchValue> values;  // one a point
  CurveSmoothness smoothness;
  std::optional<std::size_t> best;  // point of the least rms; none if none holds its goals
  FlatRange within_1_percent, within_5_percent;  // in disks
  bool best_at_end = false;                      // least at an end of the axis
};

/// The least rms along the axis when something else is not as the mission has it; tuned on that
/// plant alone.
struct MatchVariant {
  std::string name;         // what; empty: nothing, the mission's own plant
  std::vector<double> rms;  // rad at the sky, one a coarse point; NaN without a law
  std::optional<std::size_t> best;
  FlatRange within_5_percent;
};

struct MatchVariants {
  std::string structure;
  std::vector<double> disks;
  std::vector<MatchVariant> variants;  // the first is the mission's own plant
};

/// The friction slope above which the inertia does not matter any more: the rms at the worst number
/// of disks is within `spread` of that at the best. Tuned on the mission's plant with that slope.
struct FrictionThreshold {
  std::string structure;
  double spread = 0.05;
  std::optional<double> slope;      // N m s/rad; none up to `searched_to`
  double searched_to = 0.0;         // N m s/rad
  double spread_at_nominal = 0.0;   // with the mission's slope
  double spread_at_tracking = 0.0;  // with the friction curve's slope at the tracking rate
};

/// Classic rules for the motor inertia.
enum class ClassicRule {
  /// R = 1: the motors are as heavy as their load.
  one_to_one,
  /// Equal pairs of poles of two masses on the oil spring, whose damping is zeta = 1/2
  /// sqrt(J_L/J_m): 1/sqrt(2) at R = 1/2, 1 at R = 1/4.
  equal_poles_damped_0_7,
  equal_poles_damped_1,
  /// No flywheels: the most acceleration at a given gear ratio.
  no_flywheels,
};

/// A classic rule for the motor inertia, and what following it costs a structure.
struct RuleVerdict {
  ClassicRule rule = ClassicRule::one_to_one;
  double motor_to_load_ratio = 0.0;  // that it asks for
  std::optional<double> disks;       // none where the motors alone are heavier already
  std::vector<double>
      cost;  // rms over the structure's least, less 1; one a series, NaN if not known
};

/// Every structure tuned at every motor inertia, and what that says of the motors. Angles at the
/// sky.
struct MatchingStudy {
  std::vector<MatchPoint> points;  // by rising disks
  std::vector<MatchSeries> series;
  std::vector<MatchVariants> variants;
  std::vector<FrictionThreshold> thresholds;
  std::vector<RuleVerdict> rules;
  /// study_controllers of the antenna as built, whose recommended_law is the controller for its
  /// motors; none where that was not asked for, or interrupted.
  std::optional<TuningStudy> tuned_as_built;
  double wind_speed = 0.0;
  plant::WindModel wind_model = plant::WindModel::coherence;
  HardGoals goals;
  SoftGoal soft_goal;
  std::size_t members = 0;
  double tolerance = 0.0;  // of ln rms: a law better by less counts as the same
  int starts = 0;          // random ones of each law
  int rounds = 0;
  bool settled = false;
  long evaluations = 0;
  double slew_distance = 0.0;  // rad at the sky
  /// rad/s at the sky: the mission's, or four fifths of what the supply holds against friction.
  double slew_rate = 0.0;
  bool slew_by_simulation = false;  // rate and acceleration by design::within_reach
  double tracking_rate = 0.0;       // rad/s at the sky
  double tracking_friction = 0.0;   // N m s/rad
  double friction = 0.0;            // N m s/rad, of the linear plant
  double tightest_budget = 0.0;     // rad rms at the sky; 1 mdeg where the mission has none
};

/// At which numbers of disks laws are run on the nonlinear antenna: all; 0 disks, ratio 1 and as
/// built; none.
enum class MatchTimeRuns { none, few, all };

struct MatchOptions {
  std::vector<NamedStructure> structures;  // empty: as the mission has it
  int points = 25;                         // evenly spaced in disks, beside ratio 1 and as built
  double most_disks = 0.0;                 // 0: as the mission has it
  int starts = 4;
  MatchTimeRuns time_runs = MatchTimeRuns::few;
  bool robust = true;  // every goal held on every member of the ensemble, not on one plant alone
  bool variants = true;
  bool tune_as_built = false;  // MatchingStudy::tuned_as_built
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// What is being done, steps done and all steps of it; called from any thread, under a lock.
  std::function<void(std::string_view work, std::size_t done, std::size_t all)> progress;
  /// Asked now and then, from any thread; true ends the work with what is whole by then.
  std::function<bool()> interrupted;
};

/// Every structure tuned robustly at every motor inertia (match_motors), looked at from every side,
/// and judged; then what moves the optimum (vary), and the controllers of the antenna as built. The
/// same for any number of threads.
/// @throws InvalidInput for structures asked for twice, fewer than 4 points, a most_disks that is
/// not positive, and as plant::changed, constraints, match_motors and tune_structures.
MatchingStudy study_matching(const Mission& mission, const PlantEnsemble& ensemble,
                             const MatchOptions& options);

}  // namespace boresight::design
