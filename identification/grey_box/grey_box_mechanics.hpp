#pragma once

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_record.hpp>

namespace boresight::identification {

/// Coefficients of the mechanical half, as the recorder shows torque (N m) and rate (rad/s); the
/// structure's follow: inertia and frequency of every mode of the locked rotor.
struct MechanicalCoefficients {
  enum : Eigen::Index {
    rigid_inertia,      // kg m2: what turns rigidly with the motors
    coulomb_torque,     // N m, these six the friction curve: see plant::FrictionCurve
    stribeck_torque,    // N m: breakaway less Coulomb
    stribeck_rate,      // rad/s
    saturating_torque,  // N m
    saturating_rate,    // rad/s
    viscous_friction,   // N m s/rad
    bristle_stiffness,  // N m/rad
    bristle_damping,    // N m s/rad
    offset_torque,      // N m
    common_torque,      // N m per N m of both sides' mean: unlike gains of inlets and outlets
    tachometer_zero,    // rad/s
    tachometer_lag,     // s
    correction,         // N m per rad/s of prediction error
    mode_damping,       // ratio, of every mode
    modes               // inertia (kg m2) and frequency (rad/s) of each
  };
  static Eigen::Index inertia(Eigen::Index mode) { return modes + 2 * mode; }
  static Eigen::Index frequency(Eigen::Index mode) { return modes + 2 * mode + 1; }
  static Eigen::Index count(Eigen::Index mode_count) { return modes + 2 * mode_count; }
};

/// Predicts the recorded motor rate from the recorded torque, one step ahead:
///   Jr v' + sum mu_i a_i' = T - friction(v, z) - offset - c common + L (rate - predicted rate)
///   s_i' = a_i - v,  a_i' = -w_i^2 s_i - 2 zeta w_i (a_i - v)       structure, on a locked rotor
///   z' = v - sigma0 |v| z/g(v),  friction = sigma0 z + sigma1 z' + Bv v (plant::MotorFriction)
///   predicted rate = tachometer zero + v through a lag
/// The structure as masses mu_i that its foot, the motor, moves: the modal form of any load on a
/// gear spring, whose frequencies are those of the locked rotor. Its steps are exact for a rate
/// that is straight between samples, the bristles' for a constant one, and the momentum balance
/// holds over every step; the one implicit equation is solved for the mean rate.
///
/// Writes measured less predicted rate, one a sample, and, unless `jacobian` is null, its
/// derivatives (coefficients x samples). Not finite where the model has no solution.
/// O(samples x modes x coefficients). Nothing is allocated per sample.
/// @throws InvalidInput for a number of coefficients that is none of count(modes).
void predict_rate(const GreyBoxRecord& record, const Eigen::VectorXd& coefficients,
                  Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian);

/// One prediction step after another, for driving the model by something other than a record.
class MechanicalStepper {
 public:
  MechanicalStepper(Eigen::VectorXd coefficients, double sample_time, bool derivatives);

  /// At rest or in even motion at this rate under this torque.
  void restart(double rate, double torque);
  /// Over one sample time: mean torque, mean common torque, prediction error at its start and (with
  /// derivatives) that error's derivatives. False where the equation has no solution.
  bool step(double torque, double common, double error, const Eigen::VectorXd& error_by);

  double rate() const { return v_; }           // rad/s, of the motor
  double tachometer() const { return tach_; }  // rad/s, after the lag, without zero
  /// By the coefficients.
  auto tachometer_by() const { return by_.col(2); }

 private:
  struct Mode {
    double inertia = 0.0;
    // [s; a] at the end of a step from [s; a] and v at its start, v at its end; and what these
    // change with frequency and damping.
    Eigen::Matrix<double, 2, 4> step, by_frequency, by_damping;
  };
  struct Bristle {
    double mean_torque = 0.0, end = 0.0;  // N m over the step; z at its end
    double torque_by_rate = 0.0, end_by_rate = 0.0;
    double torque_by_z = 0.0, end_by_z = 0.0;
    Eigen::Matrix<double, 8, 1> torque_by, end_by;  // coulomb_torque .. bristle_damping
  };
  void bristle(double mean_rate, bool derivatives, Bristle& out) const;
  bool solve(double push, double& mean_rate, Bristle& b) const;
  void differentiate(double mean_rate, double common, double error, const Eigen::VectorXd& error_by,
                     const Bristle& b);

  Eigen::VectorXd c_;
  double h_;
  bool derivatives_;
  std::vector<Mode> modes_;
  double effective_inertia_ = 0.0;  // that the end rate multiplies in the momentum balance
  double lag_decay_ = 0.0, lag_start_ = 0.0, lag_end_ = 0.0;
  double lag_decay_by_ = 0.0, lag_start_by_ = 0.0, lag_end_by_ = 0.0;
  double v_ = 0.0, z_ = 0.0, tach_ = 0.0;
  double last_change_ = 0.0;  // of v, over the step before
  std::vector<Eigen::Vector2d> x_;
  // Columns: v, z, tachometer, then s and a of every mode; and scratch.
  Eigen::MatrixXd by_;
  Eigen::VectorXd mean_by_, end_rate_by_, s_by_, scratch_;
};

}  // namespace boresight::identification
