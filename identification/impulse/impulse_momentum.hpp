#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/friction/friction_curve_fit.hpp>
#include <boresight/identification/friction/friction_tests.hpp>
#include <boresight/identification/impulse/impulse_evaluation.hpp>
#include <boresight/identification/impulse/impulse_windows.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// Which windows the impulse is taken over.
enum class WindowRule {
  two_on_the_ramp,     // ramp_windows, averaged
  every_speed_change,  // impulse_windows, pooled
  same_path,           // common_path of these
  whole_records        // the friction curve's fit, inertia among its parameters
};

/// What is taken for friction and offset.
enum class FrictionTreatment {
  constant_speed_line,  // the straight line and offset of the constant-speed tests
  slow_ramp_line,       // Coulomb friction and offset of the slow ramp, the constant-speed slope
  curve,                // the fitted curve
  cancelled             // none: it cancels between accelerating and decelerating
};

/// Share of a source in an estimate's variance.
struct VarianceShare {
  std::string source;
  double share = 0.0;
};

/// Reflected inertia by one rule and one treatment.
struct ImpulseEstimate {
  WindowRule rule = WindowRule::two_on_the_ramp;
  FrictionTreatment treatment = FrictionTreatment::curve;
  std::string name;
  /// kg m2, of the antenna: with errors of transducers, tachometer scale, displacement and torque
  /// efficiency.
  numerics::Interval inertia;
  /// The same as the recorder shows torque and rate, without these.
  numerics::Interval as_recorded;
  std::vector<VarianceShare> shares;  // largest first
  std::vector<WindowImpulse> windows;
  /// By each window alone, kg m2.
  std::vector<double> by_window;
  /// Where there is a friction curve, for the other treatments: kg m2 by which they differ from it
  /// over the same windows. It is in the intervals, as a standard uncertainty.
  std::optional<double> friction_model_error;
  std::string note;
};

struct ImpulseMomentumOptions {
  FrictionTestOptions tests;
  FrictionCurveOptions curve;
  ImpulseWindowOptions windows;
  int draws = 400;  // of the Monte Carlo; the tests' own number and seed are replaced by these
  std::uint64_t seed = 1;
  /// Windows are shortened in the draws at either end by 0, 1 or 2 times this share.
  double shortening = 0.05;
};

struct ImpulseMomentum {
  std::optional<ConstantSpeedTests> constant_speed;
  std::optional<SlowRampTests> slow_ramp;
  std::optional<FrictionCurveFit> friction;
  std::vector<ImpulseEstimate> estimates;
  /// The one with the least assumptions: whole records where there is a curve, else the same path.
  std::optional<std::size_t> best;
  std::vector<std::string> notes;
  const ImpulseEstimate* find(WindowRule rule, FrictionTreatment treatment) const;
};

/// Method 3: friction from constant-speed tests, slow ramps and as one curve, and the reflected
/// inertia from impulse and momentum (Sommerville eqs. 28-31) by every rule and treatment that the
/// campaign's tests allow; each with a Monte Carlo interval over pressure gains and zeros,
/// tachometer scale, displacement and torque efficiency, the windows' ends, the friction model's
/// own scatter, the scatter between windows and the structure's flexibility
/// (structural_jerk_inertia; Sommerville's two windows take none into account). What the tests do
/// not allow is in the notes. The mass properties enter only as where the curve's fit starts (with
/// 30 %). Deterministic by the seed.
/// @throws InvalidInput for a campaign without records, whose records have different numbers of
/// motors, or options out of range; NumericalFailure where no estimate is possible.
ImpulseMomentum impulse_momentum(const Campaign& campaign,
                                 const ImpulseMomentumOptions& options = {});

}  // namespace boresight::identification
