#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/records/instrument_errors.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::identification {

struct FrictionCurveOptions {
  /// Records whose windows are used; empty: constant-speed, slow-ramp, fast-ramp, valve-step and
  /// valve-chirp tests.
  std::vector<TestKind> tests;
  /// Length of a window (s), all of it flanks; windows overlap by half. 0: two periods of the
  /// lowest locked-rotor mode, 1 s where none is known.
  double window_time = 0.0;
  double guard_time = 0.1;  // s about clipped or missing samples
  /// Standard deviation expected of the tachometer's zero, relative to the rate's limit or largest
  /// value. The fit finds the zero from the two directions.
  double tachometer_zero = 0.002;
  /// Unexplained torque of one window, relative to the window's own, in addition to the scatter
  /// found. It keeps fast tests from outweighing slow ones.
  double relative_scatter = 0.003;
  /// Torque disturbances (wind) are taken as independent after this time (s).
  double correlation_time = 20.0;
};

/// Measured friction of a window: torque less those of inertia and offset, means over the window.
struct FrictionPoint {
  std::size_t record = 0;  // of the campaign
  double time = 0.0;       // s, the window's middle
  double rate = 0.0;       // rad/s, the tachometer's zero removed
  double friction = 0.0;   // N m, sign of the rate
  double fitted = 0.0;     // N m
};

/// A parameter of the fit as it was recorded: without the transducers' own errors.
struct FittedParameter {
  std::string name;
  numerics::Interval interval;
  /// False: the data determine no more than the order of magnitude (a factor of 2 either way at one
  /// standard deviation, or little more than the prior).
  bool determined = true;
};

/// Steady friction and offset torque from all tests, as the recorder shows torque and rate.
struct FrictionCurveFit {
  plant::FrictionCurve curve;
  double offset = 0.0;           // N m: drive torque = friction + offset
  double tachometer_zero = 0.0;  // rad/s shown at rest
  double inertia = 0.0;          // kg m2
  /// N m/Pa: torque that the record shows in proportion to the level common to all ports, because
  /// the inlets' transducers have other gains than the outlets'. `offset` is that at the mean
  /// level.
  double torque_by_common_pressure = 0.0;
  double mean_common_pressure = 0.0;       // Pa
  double common_pressure_variation = 0.0;  // Pa rms over the windows
  /// Order of `covariance` and of the rows below: ln of Tc, Ts - Tc, ws, Th, wh, Bv; offset;
  /// tachometer zero; inertia; torque by common pressure.
  Eigen::VectorXd estimate;
  Eigen::MatrixXd covariance;
  /// Change of the estimate per relative gain error and per Pa of zero error removed from each
  /// pressure channel.
  Eigen::MatrixXd by_pressure_gain;
  Eigen::MatrixXd by_pressure_zero;
  std::vector<FittedParameter> parameters;
  std::vector<FrictionPoint> points;
  double lowest_rate = 0.0;  // rad/s, over the windows used
  double highest_rate = 0.0;
  double scatter = 0.0;  // N m rms of the points about the curve
  std::vector<std::string> notes;
};

/// Steady curve of plant::FrictionCurve plus offset, fitted to the integrated equation of motion of
/// many windows of the campaign's tests, with the inertia's torque J dw/dt, J known to its standard
/// uncertainty (a parameter with that prior), and the structure's (structural_jerk_inertia).
/// Weighted least squares with Huber's bound on outliers; start by a grid over the two rates ws and
/// wh with nonnegative linear least squares in the others, then Levenberg-Marquardt in the
/// logarithms. The covariance allows for residuals correlated in time (W. K. Newey, K. D. West,
/// Econometrica 55, 1987).
/// @throws InvalidInput for a campaign without usable records or an inertia that is not positive;
/// NumericalFailure where fewer than 20 windows move or the windows do not move both ways.
FrictionCurveFit fit_friction_curve(const Campaign& campaign, const numerics::Uncertain& inertia,
                                    const FrictionCurveOptions& options = {});

/// Friction (N m, odd in the rate) of an estimate in the order of FrictionCurveFit::estimate.
plant::FrictionCurve friction_curve(const Eigen::VectorXd& estimate);

/// Friction torque at a rate of either sign with its interval, as the recorder shows torque and
/// rate: from the fit's covariance alone.
numerics::Interval friction_as_recorded(const FrictionCurveFit& fit, double rate);

/// The same for the antenna: includes the possible errors of transducers, tachometer scale,
/// displacement and torque efficiency, to first order. Beyond the windows' rates the friction model
/// extrapolates.
numerics::Interval friction_of_antenna(const FrictionCurveFit& fit, const Campaign& campaign,
                                       double rate);

/// Offset torque in the recorded torque, at the mean common pressure; where that level varies the
/// record has no single offset: its variation is in the interval.
numerics::Interval offset_as_recorded(const FrictionCurveFit& fit);

/// Offset torque of the antenna: what the unequal gains at the common pressure show is removed, the
/// transducers' zeros remain in the interval.
numerics::Interval offset_of_antenna(const FrictionCurveFit& fit, const Campaign& campaign);

/// Derivatives of the friction torque (N m, sign of the rate) by the first six parameters of the
/// estimate, the logarithms.
Eigen::VectorXd friction_gradient(const plant::FrictionCurve& curve, double rate);

/// Change of the fit's estimate in sample number `draw` of a seed. Use it to first order only,
/// since parameters that the data do not determine must not be extrapolated far. It includes the
/// fit's own scatter and the transducers' errors of that sample. `factor`: of the covariance, n x
/// rank, by numerics::semidefinite_factor.
Eigen::VectorXd draw_friction(const FrictionCurveFit& fit, const Eigen::MatrixXd& factor,
                              const InstrumentErrors& errors, std::uint64_t seed,
                              std::uint64_t draw);

/// Gain errors of a sample without the part estimated by the fit: the part in which all inlets read
/// high and all outlets low together, which is `torque_by_common_pressure`.
Eigen::VectorXd remaining_gain_errors(const Eigen::VectorXd& pressure_gain, Eigen::Index inlets);

}  // namespace boresight::identification
