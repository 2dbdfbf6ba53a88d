#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// Measured responses of a drive to its valve command, at the motor shaft.
struct MeasuredPlant {
  Eigen::ArrayXd frequency;      // rad/s, positive, each once, in any order
  Eigen::ArrayXcd tachometer;    // rad/s per rad/s of valve command, tachometer lag included
  Eigen::ArrayXcd motor_torque;  // N m per rad/s
  /// rad of motor per rad/s; empty if no encoder was recorded. The encoder is then assumed to turn
  /// with the motor (a rigid gear train).
  Eigen::ArrayXcd encoder;
  /// E[e e^H] of the complex errors of tachometer, torque and encoder, one per frequency; empty if
  /// the errors are not known.
  std::vector<Eigen::Matrix3cd> covariance;
  /// Degrees of freedom (complex) of the covariance estimate; 0: covariance known exactly.
  double degrees_of_freedom = 0.0;
  /// Coherence with the command, frequencies x (tachometer, torque, encoder), 0 to 1; empty if not
  /// known.
  Eigen::ArrayXXd coherence;
};

/// The drive parameters that a chirp alone does not determine: T = H (V u - w), H = K/(s + lambda).
struct OilSpring {
  double stiffness = 0.0;  // K, N m/rad
  double loss_rate = 0.0;  // lambda, 1/s: leakage and orifices, as in the record's motion
};

/// Flexure beyond the encoder (non-collocated), from a model of the structure.
struct BendingPoint {
  std::complex<double> boresight_per_encoder{1.0, 0.0};  // rad/rad
  std::complex<double> boresight_per_wind{0.0, 0.0};     // rad/(N m), encoder fixed
};

struct MeasuredChannelOptions {
  /// Points with a lower coherence of tachometer or torque are omitted. If only the encoder has a
  /// lower coherence (high frequencies, small angles), its ratio to the motor is taken from the
  /// next lower frequency with sufficient coherence. Its uncertainty is then 100 %.
  double lowest_coherence = 0.6;
  /// As in MeasuredLoopOptions, for every channel. Unresolved intervals are interpolated and
  /// reported.
  double largest_turn_deg = 60.0;
  double largest_factor = 2.0;
  double widest_step = 4.0;
  /// Fraction of the band (in ln w) that usable points must resolve.
  double min_resolved = 0.5;
  /// The points up to this factor above the lowest frequency determine the behaviour below it.
  double low_end_factor = 2.5;
  /// Above the highest frequency magnitudes are assumed to fall as w^-roll_off (one power more for
  /// the encoder) at the phase of the last point.
  double roll_off = 2.0;
  /// Flexure at a frequency in rad/s; if empty, the boresight angle is taken as the encoder angle.
  std::function<BendingPoint(double frequency)> bending;
};

/// Basis of a response at a frequency.
enum class ResponseBasis {
  assumed_below,  // below the lowest usable point
  measured,
  encoder_assumed,  // tachometer and torque are measured
  unresolved,       // between usable points that do not resolve it
  assumed_above     // above the highest usable point
};

/// Interval between two usable points, rad/s.
struct PointBand {
  double lowest = 0.0;
  double highest = 0.0;
};

/// Loop channels from a measured response, without a model of the antenna.
///
/// Command. Between usable points ln magnitude and phase are cubics in ln w, with the slopes of
/// parabolas through three points. Below the lowest point the drive is assumed to turn as one rigid
/// body. Tachometer per command, motor torque per rate and encoder rate per motor rate are then
/// extrapolated as a + b w^2 + j c w (even real, odd imaginary part, as for every real system). The
/// coefficients are fitted to the lowest points. Above the highest point a roll-off is assumed.
/// basis() returns which case applies at a frequency.
///
/// Wind, as a torque w at the motor shaft. The same test also determines the response to this
/// torque: Y = tachometer/torque = F Y0. Y0 is the driving-point admittance of the shaft with
/// everything behind it, and F = wt/(s + wt) is the tachometer's lag. With u = 0 the oil responds
/// with T = -H w_m, so
///   w_m = Y0/(1 + H Y0) w,   tachometer = F w_m,   torque = -H w_m,
///   encoder = (encoder/tachometer by command) F w_m,
/// because command and torque both act at the shaft and everything behind it follows the shaft. Y0
/// is measured; H and F are not. Below the hydraulic resonance |H Y0| >> 1 and w_m = w/H: the wind
/// response there depends on K and lambda only.
///
/// Not included: wind acts on the dish and bends the structure on its way to the shaft. The
/// difference of boresight and encoder angle is included only if options.bending predicts it.
class MeasuredChannels {
 public:
  /// `tachometer_corner`: rad/s of F.
  /// @throws InvalidInput for arrays of different length, values that are not finite, frequencies
  /// that are not positive or occur twice, a coherence outside 0 to 1, an oil spring, corner or
  /// option out of range, or a drive that turns against its command; NumericalFailure for fewer
  /// than 12 usable points or a band with too little resolved.
  MeasuredChannels(const MeasuredPlant& plant, const OilSpring& oil, double tachometer_corner,
                   const MeasuredChannelOptions& options = {});

  /// `frequency`: rad/s, above 0.
  plant::ResponsePoint at(double frequency) const;
  ResponseBasis basis(double frequency) const;
  /// E[e e^H] of the errors of at()'s tachometer_command, torque_command and encoder_command. Where
  /// the response is assumed, the relative covariance of the nearest measured point is used.
  Eigen::Matrix3cd covariance(double frequency) const;
  /// The point with errors `change` in tachometer, torque and encoder per command. The wind
  /// response changes accordingly.
  plant::ResponsePoint changed(double frequency, const Eigen::Vector3cd& change) const;

  /// The same measurement with another oil spring; only the wind response changes.
  /// @throws InvalidInput as the constructor.
  MeasuredChannels with_oil(const OilSpring& oil) const;

  /// For a LoopEvaluator, on any grid.
  LoopChannels on(const Eigen::ArrayXd& grid) const;

  /// Usable points, rising, rad/s.
  const Eigen::ArrayXd& frequency() const;
  double lowest_frequency() const { return frequency()[0]; }
  double highest_frequency() const { return frequency()[frequency().size() - 1]; }
  std::size_t points_left_out() const;  // for low coherence, or because a response is 0
  const std::vector<PointBand>& unresolved() const;
  const std::vector<PointBand>& encoder_assumed() const;
  /// Fraction of ln(highest/lowest) that is resolved.
  double resolved_fraction() const;
  double degrees_of_freedom() const;
  bool has_covariance() const;
  bool has_encoder() const;
  const OilSpring& oil() const;
  /// Inertia (kg m2) and friction (N m s/rad) of the complete axis, from the lowest points.
  double low_end_inertia() const;
  double low_end_friction() const;

 private:
  struct Data;
  explicit MeasuredChannels(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Loop channels of any response, sampled on a grid (rad/s, above 0).
LoopChannels sampled_on(const Eigen::ArrayXd& grid,
                        std::function<plant::ResponsePoint(double frequency)> at);

}  // namespace boresight::control
