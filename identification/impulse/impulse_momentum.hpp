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

/// The windows used for the impulse.
enum class WindowRule {
  two_on_the_ramp,     // ramp_windows, averaged
  every_speed_change,  // impulse_windows, pooled
  same_path,           // common_path of these
  whole_records        // the friction curve's fit, inertia among its parameters
};

/// The model of friction and offset.
enum class FrictionTreatment {
  constant_speed_line,  // the straight line and offset of the constant-speed tests
  slow_ramp_line,       // Coulomb friction and offset of the slow ramp, the constant-speed slope
  curve,                // the fitted curve
  cancelled             // none: it cancels between accelerating and decelerating
};

/// Fraction of an estimate's variance due to one source.
struct VarianceFraction {
  std::string source;
  double fraction = 0.0;
};

/// Reflected inertia by one rule and one treatment.
struct ImpulseEstimate {
  WindowRule rule = WindowRule::two_on_the_ramp;
  FrictionTreatment treatment = FrictionTreatment::curve;
  std::string name;
  /// Of the antenna (kg m2); includes errors of transducers, tachometer scale, displacement and
  /// torque efficiency.
  numerics::Interval inertia;
  /// The same for torque and rate as recorded, without these errors.
  numerics::Interval as_recorded;
  std::vector<VarianceFraction> fractions;  // largest first
  std::vector<WindowImpulse> windows;
  /// By each window alone, kg m2.
  std::vector<double> by_window;
  /// Difference (kg m2) of another treatment from the friction curve over the same windows, if
  /// there is a curve. The intervals include it as a standard uncertainty.
  std::optional<double> friction_model_error;
  std::string note;
};

struct ImpulseMomentumOptions {
  FrictionTestOptions tests;
  FrictionCurveOptions curve;
  ImpulseWindowOptions windows;
  int random_samples =
      400;  // of the Monte Carlo; the tests' own number and seed are replaced by these
  std::uint64_t seed = 1;
  /// In the samples, windows are shortened at either end by 0, 1 or 2 times this fraction.
  double shortening = 0.05;
};

struct ImpulseMomentum {
  std::optional<ConstantSpeedTests> constant_speed;
  std::optional<SlowRampTests> slow_ramp;
  std::optional<FrictionCurveFit> friction;
  std::vector<ImpulseEstimate> estimates;
  /// The one with the fewest assumptions: whole records if there is a curve, else the same path.
  std::optional<std::size_t> best;
  std::vector<std::string> notes;
  const ImpulseEstimate* find(WindowRule rule, FrictionTreatment treatment) const;
};

/// Method 3: friction from constant-speed tests, slow ramps and as one curve. The reflected inertia
/// follows from impulse and momentum (Sommerville eqs. 28-31), by every rule and treatment that the
/// campaign's tests allow. Each estimate has a Monte Carlo interval over pressure gains and zeros,
/// tachometer scale, displacement and torque efficiency. The interval also covers the windows'
/// ends, the friction model's scatter, the scatter between windows, and the structure's flexibility
/// (structural_jerk_inertia). Sommerville's two windows do not account for flexibility. The notes
/// state what the tests do not allow. The mass properties only set the start of the curve's fit
/// (with 30 %). Deterministic by the seed.
/// @throws InvalidInput for a campaign without records, records with different numbers of motors,
/// or options out of range; NumericalFailure if no estimate is possible.
ImpulseMomentum impulse_momentum(const Campaign& campaign,
                                 const ImpulseMomentumOptions& options = {});

}  // namespace boresight::identification
