#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// Responses of a drive to its valve command as a test measured them, at the motor shaft.
struct MeasuredPlant {
  Eigen::ArrayXd frequency;      // rad/s, positive, each once, in any order
  Eigen::ArrayXcd tachometer;    // rad/s per rad/s of valve command, the tachometer's lag in it
  Eigen::ArrayXcd motor_torque;  // N m per rad/s
  /// rad of motor per rad/s; empty if no encoder was recorded: it is then taken to turn with the
  /// motor (a rigid gear train).
  Eigen::ArrayXcd encoder;
  /// E[e e^H] of the complex errors of tachometer, torque and encoder, one a frequency; empty: no
  /// errors known.
  std::vector<Eigen::Matrix3cd> covariance;
  /// Degrees of freedom (complex) that the covariance was estimated with; 0: known.
  double degrees_of_freedom = 0.0;
  /// Coherence with the command, frequencies x (tachometer, torque, encoder), 0 to 1; empty: not
  /// known.
  Eigen::ArrayXXd coherence;
};

/// What a chirp alone does not tell of the drive: T = H (V u - w), H = K/(s + lambda).
struct OilSpring {
  double stiffness = 0.0;  // K, N m/rad
  double loss_rate = 0.0;  // lambda, 1/s: leakage and orifices, as in the record's motion
};

/// Bending that no encoder sees, by a model of the structure.
struct BendingPoint {
  std::complex<double> beam_per_encoder{1.0, 0.0};  // rad/rad
  std::complex<double> beam_per_wind{0.0, 0.0};     // rad/(N m), encoder held
};

struct MeasuredChannelOptions {
  /// Points where tachometer or torque has less are left out. Where only the encoder has less, as
  /// at high frequencies, where angles are small, it is assumed to turn with the motor as at the
  /// next lower frequency where it had more, uncertain by all of itself.
  double lowest_coherence = 0.6;
  /// As in MeasuredLoopOptions, of every channel: what is not resolved is crossed by the
  /// interpolation, and said so.
  double largest_turn_deg = 60.0;
  double largest_factor = 2.0;
  double widest_step = 4.0;
  /// Share of the band (in ln w) that usable points must resolve.
  double least_resolved = 0.5;
  /// The points up to this factor above the lowest frequency give the behaviour below it.
  double low_end_factor = 2.5;
  /// Above the highest frequency magnitudes are assumed to fall as w^-roll_off (the encoder's by
  /// one power more) at the last point's phase.
  double roll_off = 2.0;
  /// At a frequency in rad/s; empty: the beam is taken for the encoder's angle.
  std::function<BendingPoint(double frequency)> bending;
};

/// What a response at a frequency rests on.
enum class ResponseBasis {
  assumed_below,  // the lowest usable point
  measured,
  encoder_assumed,  // tachometer and torque are measured
  unresolved,       // usable points do not say what happens between them
  assumed_above     // the highest usable point
};

/// From one usable point to another, rad/s.
struct PointBand {
  double lowest = 0.0;
  double highest = 0.0;
};

/// Loop channels from a measured response, without a model of the antenna.
///
/// Command. Between usable points ln magnitude and phase follow cubics in ln w with the slopes of
/// parabolas through three points. Below the lowest, the drive is assumed to turn as one body:
/// tachometer per command, motor torque per rate and encoder rate per motor rate go on as a + b w^2
/// + j c w (even real, odd imaginary parts, as every real system's), fitted to the lowest points.
/// Above the highest a roll-off is assumed. basis() says which holds where.
///
/// Wind, as a torque w at the motor shaft. The same test measured what a torque there does:
/// Y = tachometer/torque = F Y0, Y0 the shaft's driving-point admittance with everything behind it,
/// F = wt/(s + wt) the tachometer's lag. With u = 0 the oil answers T = -H w_m, so
///   w_m = Y0/(1 + H Y0) w,   tachometer = F w_m,   torque = -H w_m,
///   encoder = (encoder/tachometer by command) F w_m,
/// as command and torque both act at the shaft and everything behind it follows the shaft. Y0 is
/// measured; H and F are not. Below the hydraulic resonance |H Y0| >> 1 and w_m = w/H: there the
/// wind's way rests on K and lambda alone.
///
/// Not in it: that wind acts on the dish and bends the structure on its way to the shaft, and that
/// the beam is not where the encoder is (unless options.bending predicts it).
class MeasuredChannels {
 public:
  /// `tachometer_corner`: rad/s of F.
  /// @throws InvalidInput for arrays of different length, values that are not finite, frequencies
  /// that are not positive or come twice, a coherence outside 0 to 1, an oil spring, corner or
  /// option out of range, or a drive that turns against its command; NumericalFailure where the
  /// usable points are fewer than 12 or resolve too little of the band.
  MeasuredChannels(const MeasuredPlant& plant, const OilSpring& oil, double tachometer_corner,
                   const MeasuredChannelOptions& options = {});

  /// `frequency`: rad/s, above 0.
  plant::ResponsePoint at(double frequency) const;
  ResponseBasis basis(double frequency) const;
  /// E[e e^H] of the errors of at()'s tachometer_command, torque_command and encoder_command; where
  /// the response is assumed, relatively that of the nearest measured point.
  Eigen::Matrix3cd covariance(double frequency) const;
  /// The point with errors `change` in tachometer, torque and encoder per command: what wind does
  /// follows them.
  plant::ResponsePoint changed(double frequency, const Eigen::Vector3cd& change) const;

  /// The same measurement with another oil spring: only what the wind does changes.
  /// @throws InvalidInput as the constructor.
  MeasuredChannels with_oil(const OilSpring& oil) const;

  /// For a LoopEvaluator, on any grid.
  LoopChannels on(const Eigen::ArrayXd& grid) const;

  /// Usable points, rising, rad/s.
  const Eigen::ArrayXd& frequency() const;
  double lowest_frequency() const { return frequency()[0]; }
  double highest_frequency() const { return frequency()[frequency().size() - 1]; }
  std::size_t points_left_out() const;  // for their coherence, or because a response is 0
  const std::vector<PointBand>& unresolved() const;
  const std::vector<PointBand>& encoder_assumed() const;
  /// Share of ln(highest/lowest) that is resolved.
  double resolved_share() const;
  double degrees_of_freedom() const;
  bool has_covariance() const;
  bool has_encoder() const;
  const OilSpring& oil() const;
  /// Inertia and friction of the whole as the lowest points show them, kg m2 and N m s/rad.
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
