#pragma once

#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/signals/damped_cosine.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// Free oscillation of oil and inertia after one valve step while the antenna moves.
struct StepRing {
  double time = 0.0;             // of the step, s from the record's first sample
  double mean_rate = 0.0;        // rad/s
  double mean_torque = 0.0;      // N m
  numerics::Interval frequency;  // undamped natural, Hz
  numerics::Interval damping_ratio;
  RingPole pole;
  /// Torque over rate in this mode, N m s/rad: the mode shape, which gives stiffness and loss.
  std::complex<double> torque_over_rate;
  /// K and lambda of dT/dt = -K w - lambda T with this pole and shape (oil data not used).
  double stiffness = 0.0;        // N m/rad
  double total_loss_rate = 0.0;  // 1/s
  double leakage_rate = 0.0;     // less the contribution of the valve's orifices, 1/s
  /// N m/rad and 1/s, by the fit's noise.
  double stiffness_uncertainty = 0.0;
  double loss_uncertainty = 0.0;
};

struct StepRingOptions {
  /// Hz, expected frequency of the mode.
  double expected_frequency = 0.0;
  double lowest_fraction = 0.5;  // of it: the search's band
  double highest_fraction = 1.6;
  /// The fit begins this long after a step (s; at least a thirtieth of a period) ...
  double settling_time = 0.04;
  /// ... and lasts this many periods of the expected frequency.
  double periods = 1.75;
  /// Steps of the valve command that exceed its noise by this many standard deviations.
  double step_threshold = 8.0;
};

struct StepRings {
  std::vector<StepRing> rings;
  numerics::Interval frequency;  // Hz, pooled: random effects over the steps
  numerics::Interval damping_ratio;
  numerics::Interval stiffness;  // from the shapes, N m/rad, transducers' scales in it
  numerics::Interval total_loss_rate;
  /// The orifices' part is taken as known to 6 %. The lines' resistance, not separated here (unlike
  /// in OilRelation), is allowed for with 5 % of the total.
  numerics::Interval leakage_rate;
  /// Standard deviations between the steps beyond each fit's own, caused by correlation in time and
  /// nonlinearity.
  double frequency_between = 0.0;
  std::vector<std::string> notes;
  /// Plot of the first ring used: time from the window's start, torque and rate less their trend,
  /// and the fit of both.
  Eigen::VectorXd plot_time;
  Eigen::MatrixXd plot_signals;  // samples x {torque, rate}
  Eigen::MatrixXd plot_fitted;
};

/// Fits the hydraulic mode and the lowest structural mode to torque and rate together, after each
/// valve step about a moving operating point. A step is left out if the drive is not yet moving,
/// changes direction, or has an invalid rate. Without a recorded valve command, steps are found at
/// jumps of K w + dT/dt, with K from the oil data (`stiffness`, N m/rad).
/// @throws InvalidInput unless expected_frequency and stiffness are positive; NumericalFailure if
/// no step leaves a usable ringing.
StepRings fit_step_rings(const DriveRecord& record, const Campaign& campaign, double stiffness,
                         const StepRingOptions& options);

/// Times (s) at which the record's valve flow steps, as fit_step_rings finds them.
std::vector<double> valve_step_times(const DriveRecord& record, const DriveKnowledge& knowledge,
                                     double stiffness, double threshold);

}  // namespace boresight::identification
