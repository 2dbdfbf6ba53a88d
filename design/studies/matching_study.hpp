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

/// One motor inertia of the study, and the quantities that do not depend on the loops. SI units, at
/// the motor shaft unless stated otherwise.
struct MatchPoint {
  double disks = 0.0;                // on each motor
  bool unit_ratio = false;           // motor inertia equal to that of gear train and antenna
  bool as_built = false;             // the mission's own motors
  bool on_grid = true;               // one of the evenly spaced numbers of disks
  double motor_inertia = 0.0;        // kg m2, sum over all motors
  double motor_to_load_ratio = 0.0;  // R: motor inertia over inertia of gear train and antenna
  double reflected_inertia = 0.0;    // kg m2, total
  plant::PlantMode hydraulic = {};
  plant::PlantMode oil_mode = {};  // plant::mode_of_oil
  /// rad/s2 at the sky, at the slew rate: the acceleration that the drive reaches with its reserve
  /// (design::achievable_limits). Without Antenna::nonlinear: from the supply's torque less
  /// friction, without the valve's pressure drop. 0 or less where no torque is left.
  double acceleration = 0.0;
  double slew_time = 0.0;  // s for slew_distance at the slew rate; infinite without acceleration
  double two_mass_damping = 0.0;  // the rule zeta = 1/2 sqrt(J_L/J_m)
  /// Acceleration for given torque, relative to the maximum over all gear ratios with these motors:
  /// 2 sqrt(R)/(1 + R).
  double acceleration_of_best_ratio = 0.0;
};

/// A controller on the nonlinear antenna: in still air, at rest and at the tracking rate, and in
/// wind.
struct MatchTimeDomain {
  std::vector<LimitCycleResult> limit_cycles;
  std::optional<ReversalResult> reversal;
  /// Over several records of wind. None for a controller with a limit cycle beyond the allowed
  /// amplitude.
  std::optional<SimulatedRms> expected = std::nullopt;
  /// Linear, root mean square over the ensemble with these motors (rms_over_members), in rad at the
  /// sky. Without an ensemble: that of the mission's plant. NaN where `expected` is none.
  double member_rms = std::numeric_limits<double>::quiet_NaN();
};

/// One controller of the study on the mission's plant. Angles at the sky, per axis.
struct MatchValue {
  bool found = false;  // some controller meets its constraints on every plant
  double boresight_rms = 0.0, wind_rms = 0.0, noise_rms = 0.0;  // rad
  double control_effort = 0.0;  // rad/s, valve command rms from sensor noise
  /// Mean wind plus crest factor times the rms of the gusts.
  double gust_demand = 0.0;  // rad/s of valve
  double gust_torque = 0.0;  // N m
  std::array<control::Margins, 3> margins;
  double bandwidth = 0.0;  // Hz: the lowest at which the position loop's |S| reaches 1/sqrt(2)
  /// rad per rad/s2: error under a constant acceleration without feedforward, 1/(w^2 L) of the
  /// position loop at the lowest frequency of the analysis. The error of a loop without position
  /// integral grows as long as the acceleration lasts: 1/w of that frequency is its duration.
  double acceleration_error = 0.0;
  Verification verification;
  std::optional<MatchTimeDomain> time_domain;
};

/// One structure over all points.
struct MatchSeries {
  std::string name;  // as the user names it
  MatchingCurve curve;
  std::vector<MatchValue> values;  // one per point
  CurveSmoothness smoothness;
  std::optional<std::size_t> best;  // of the least rms; none if no point meets the constraints
  FlatRange within_1_percent, within_5_percent;  // in disks
  bool best_at_end = false;                      // the least rms lies at an end of the axis
};

/// The least rms along the axis with one property of the mission changed, tuned on that plant
/// alone.
struct MatchVariant {
  std::string name;         // of the change; empty: none, the mission's own plant
  std::vector<double> rms;  // rad at the sky, one per coarse point; NaN without a controller
  std::optional<std::size_t> best;
  FlatRange within_5_percent;
};

struct MatchVariants {
  std::string structure;
  std::vector<double> disks;
  std::vector<MatchVariant> variants;  // the first is the mission's own plant
};

/// The friction slope above which the inertia no longer matters: the rms at the worst number of
/// disks is within `spread` of that at the best. Tuned on the mission's plant with that slope.
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
  /// R = 1: the motor inertia equals the load inertia.
  one_to_one,
  /// Equal pole pairs of two masses on the oil spring, with damping zeta = 1/2 sqrt(J_L/J_m):
  /// 1/sqrt(2) at R = 1/2, 1 at R = 1/4.
  equal_poles_damped_0_7,
  equal_poles_damped_1,
  /// No flywheels: maximum acceleration at a given gear ratio.
  no_flywheels,
};

/// A classic rule for the motor inertia, and its cost for a structure.
struct RuleVerdict {
  ClassicRule rule = ClassicRule::one_to_one;
  double motor_to_load_ratio = 0.0;  // required by the rule
  std::optional<double> disks;  // none where the motors alone already exceed the required inertia
  std::vector<double>
      cost;  // rms over the structure's least, less 1; one per series, NaN where not known
};

/// Every structure tuned at every motor inertia, and the conclusions for the motors. Angles at the
/// sky.
struct MatchingStudy {
  std::vector<MatchPoint> points;  // in order of rising disks
  std::vector<MatchSeries> series;
  std::vector<MatchVariants> variants;
  std::vector<FrictionThreshold> thresholds;
  std::vector<RuleVerdict> rules;
  /// study_controllers of the antenna as built; its recommended_tuned_controller is the controller
  /// for these motors. None where it was not requested, or interrupted.
  std::optional<TuningStudy> tuned_as_built;
  double wind_speed = 0.0;
  plant::WindModel wind_model = plant::WindModel::coherence;
  Constraints goals;
  Objective objective;
  std::size_t members = 0;
  double tolerance = 0.0;  // of ln rms: a smaller improvement does not count
  int starts = 0;          // random starts per controller
  int rounds = 0;
  bool settled = false;
  long evaluations = 0;
  double slew_distance = 0.0;  // rad at the sky
  /// rad/s at the sky: the mission's, or four fifths of the rate that the supply sustains against
  /// friction.
  double slew_rate = 0.0;
  bool slew_by_simulation = false;   // rate and acceleration by design::achievable_limits
  double tracking_rate = 0.0;        // rad/s at the sky
  double tracking_friction = 0.0;    // N m s/rad
  double friction = 0.0;             // N m s/rad, of the linear plant
  double allowed_limit_cycle = 0.0;  // rad at the sky, amplitude of the boresight
};

/// Numbers of disks at which controllers run on the nonlinear antenna: all; few (0 disks, ratio 1
/// and as built); none.
enum class MatchTimeRuns { none, few, all };

struct MatchOptions {
  /// Empty: as the mission has it. A state space is compared as built only, not over inertias.
  CandidateStructures structures;
  int points = 25;         // evenly spaced in disks, in addition to ratio 1 and as built
  double max_disks = 0.0;  // 0: as the mission has it
  int starts = 4;
  MatchTimeRuns time_runs = MatchTimeRuns::few;
  bool robust = true;  // every constraint met on every ensemble member, not on one plant alone
  bool variants = true;
  bool tune_as_built = false;  // MatchingStudy::tuned_as_built
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Receives the current work, its steps done and its steps in total; called from any thread,
  /// under a lock.
  std::function<void(std::string_view work, std::size_t done, std::size_t all)> progress;
  /// Polled from any thread; true ends the work and keeps the parts completed by then.
  std::function<bool()> interrupted;
};

/// Tunes every structure robustly at every motor inertia (match_motors) and evaluates the results.
/// It then computes what moves the optimum (vary), and the controllers of the antenna as built. The
/// result does not depend on the number of threads.
/// @throws InvalidInput for duplicate structures, fewer than 4 points, a max_disks that is not
/// positive, and as plant::changed, constraints, match_motors and tune_structures.
MatchingStudy study_matching(const Mission& mission, const PlantEnsemble& ensemble,
                             const MatchOptions& options);

}  // namespace boresight::design
