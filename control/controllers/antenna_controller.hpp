#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/friction.hpp>
#include <boresight/plant/nonlinear/sampled_controller.hpp>

namespace boresight::control {

/// Largest load, as a fraction of the supply torque, for which Feedforward opens the valve further.
inline constexpr double max_feedforward_load = 0.9;

/// Commanded rates (rad/s) below this count as rest.
inline constexpr double friction_rest_rate = 1e-9;

/// Feedforward gains from the commanded motion to rate command, valve command and expected motor
/// torque, in addition to the feedback of errors. All zero: no feedforward.
struct Feedforward {
  double rate_to_rate_command = 0.0;           // 1
  double acceleration_to_rate_command = 0.0;   // s
  double rate_to_valve_command = 0.0;          // 1
  double acceleration_to_valve_command = 0.0;  // s
  /// The torque that the motion takes, without the friction torque. A state-space controller
  /// receives the measured torque less this one.
  double rate_to_motor_torque = 0.0;          // N m s/rad
  double acceleration_to_motor_torque = 0.0;  // kg m2
  /// Friction torque at the commanded rate (with_friction), 0 at rest. The valve command gets its
  /// gains times the torque and times its change per second. A controller that reads the motor
  /// torque receives it less the friction torque.
  plant::FrictionCurve friction = {};
  double friction_to_valve_command = 0.0;         // rad/s per N m
  double friction_change_to_valve_command = 0.0;  // rad per N m
  /// Motor torque (N m) at the supply pressure less the return pressure; its droop with the flow is
  /// neglected. At a load torque T an opening u of the valve passes the flow
  /// u sqrt(1 - T/supply_torque), T positive if it acts against the flow (H. E. Merritt, Hydraulic
  /// Control Systems, 1967, ch. 5). The feedforward of the valve command is divided by that root,
  /// with T the torque of motion and friction, at most max_feedforward_load of the supply.
  /// Infinite: flow in proportion to the opening.
  double supply_torque = std::numeric_limits<double>::infinity();
};

/// Feedforward with which a plant follows its command without feedback error, to second order of
/// the motion (rigid antenna, no jerk). The plant's equations (antenna_plant.hpp) at rate w and
/// acceleration a, with T = J a + Bf w, give:
///   valve     u(t) = xv + 2 zv/wv xv',  xv = w + (T' + lambda T)/K = (1 + lambda Bf/K) w
///                    + (lambda J + Bf)/K a,
///             advanced by `delay` (s, the whole of it: computation and half a hold), plus the
///             output Q'(0) T' = Q'(0) Bf a of a pressure path;
///   tachometer w - a/(its corner), the rate command at which the rate error is 0.
/// Each is the inverse of the plant's response at low frequencies, as in M. Tomizuka, Zero phase
/// error tracking algorithm, J. Dyn. Syst. Meas. Control 109, 1987, for slow commands. Dry friction
/// is not included: with_friction. A state-space controller has no pressure path; it receives the
/// measured torque less T.
/// @throws InvalidInput as control::validate, and for a delay that is negative or not finite.
Feedforward plant_feedforward(const plant::AntennaPlant& plant, const Controller& controller,
                              double delay);

/// Adds the friction torque of the commanded rate: `fraction` (0 or more) of the curve's. The curve
/// includes viscous friction: `feedforward` is that of the plant without it. The valve command is
/// that of a torque in plant_feedforward, xv = (T' + lambda T)/K. It depends on the command alone,
/// so that it changes no loop's stability.
/// Source: B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, A survey of models, analysis tools
/// and compensation methods for the control of machines with friction, Automatica 30, 1994, sec. 6.
/// @throws InvalidInput for a fraction that is negative or not finite.
Feedforward with_friction(const Feedforward& feedforward, const plant::AntennaPlant& plant,
                          const plant::FrictionCurve& curve, double fraction);

/// The steady motion at which a controller takes over.
struct SteadyMotion {
  double valve_command = 0.0;  // rad/s
  double tachometer = 0.0;     // rad/s
  double motor_torque = 0.0;   // N m
};

/// A controller of the antenna's motion that takes over from a steady motion. Inputs and output as
/// AntennaController.
class StartedController : public plant::SampledController {
 public:
  /// Sets the state after restart() to the steady state of the controller in this motion, with the
  /// tachometer's rate as reference rate. Returns the encoder's lead over the reference (rad) in
  /// that state.
  /// @throws NumericalFailure for a controller without a steady state in constant motion.
  virtual double start_from(const SteadyMotion& motion) = 0;
};

struct AntennaControllerOptions {
  Feedforward feedforward = {};
  /// Largest magnitude of the valve command (rad/s).
  double command_limit = std::numeric_limits<double>::infinity();
  /// True if integrator windup is prevented while the command is at its limit.
  bool anti_windup = true;
};

/// A controller as it runs on the antenna's computer: sampled (sampled_controller), with
/// feedforward, and with its valve command limited. Inputs are tachometer, encoder and motor_torque
/// (only if the controller feeds it back). They are followed by the references reference (rad),
/// reference_rate (rad/s) and reference_acceleration (rad/s2, until the next sample), all of motor.
/// The output is valve_command. The computation time is part of the simulation
/// (SimulationPlan::computation_delay).
///
/// The friction torque fed forward is that of the commanded rate at the next sample, when the valve
/// command acts after a computation time of one sample. Measured torque shows it one sample later,
/// and so is corrected by the friction torque of two samples before. Commanded rates below
/// friction_rest_rate count as rest.
///
/// Anti-windup by back calculation (K. J. Astrom, T. Hagglund, PID Controllers, 1995, ch. 3.5) acts
/// on the angle. The command's excess over the limit is divided by the product of the proportional
/// gains of rate and position path. The quotient is subtracted from the reference of the
/// controller's states. This is the reference that the antenna could have followed (R. Hanus, M.
/// Kinnaert, J.-L. Henrotte, Conditioning technique, Automatica 23, 1987). One injection unwinds
/// both integrators: at the limit the states of a PI-PI controller follow 2 s^2 + (wi + wip) s + wi
/// wip = 0 instead of s^2 = 0. The injection is halved until the states at the limit are stable,
/// of a conditional integral while it holds too.
///
/// A conditional integral takes the corrected angle through its dead zone or freeze at every
/// sample. In a steady motion it is within it, at no error of the corrected angle.
///
/// A state-space controller regulates the measurements about the commanded motion: encoder less
/// reference, tachometer less the rate command's feedforward, torque less that of the motion. It
/// must be stable by itself, as it has no anti-windup.
class AntennaController final : public StartedController {
 public:
  /// @throws InvalidInput as sampled_controller, for a command limit or a supply torque that is not
  /// above 0, and feedforward that is not finite; for a state-space controller that is not stable
  /// by itself.
  AntennaController(const Controller& controller, double sample_time,
                    const AntennaControllerOptions& options = {});

  double sample_time() const override { return sample_time_; }
  const std::vector<std::string>& inputs() const override { return inputs_; }
  const std::vector<std::string>& outputs() const override { return outputs_; }
  void restart() override;
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override;

  /// The lead is 0 for a controller that integrates the angle, except for the contribution of
  /// compliance compensation.
  double start_from(const SteadyMotion& motion) override;

  /// The fraction of back calculation in use: 1, 1/2, ...; 0 without anti-windup or integrators.
  double back_calculation_fraction() const { return back_calculation_fraction_; }

 private:
  double sample_time_;
  AntennaControllerOptions options_;
  double expected_torque(double rate, double acceleration) const;
  double friction_torque(double rate) const;
  double valve_feedforward(double rate, double acceleration, double friction,
                           double friction_rate) const;
  void set(const plant::StateSpace& seen);
  void prevent_windup(const Controller& controller);
  void set_conditional(const Controller& controller);

  bool reads_torque_ = false;
  bool expects_torque_ = false;  // that of the motion: a state space's
  std::vector<std::string> inputs_, outputs_;
  // Inputs: tachometer, encoder less reference, rate command's feedforward, torque.
  Eigen::MatrixXd a_, b_;
  Eigen::RowVectorXd c_, d_;
  Eigen::VectorXd back_calculation_;
  double back_calculation_fraction_ = 0.0;
  // A conditional integral; the matrices above are then those of the rest. It takes the angle less
  // what compliance compensation estimates as flexure.
  std::optional<ConditionalIntegrator> integral_;
  double integral_back_calculation_ = 0.0;  // rad of angle error per rad/s beyond the limit
  std::optional<plant::StateSpace> compliance_;
  Eigen::VectorXd flexure_state_, initial_flexure_state_;
  double initial_integral_ = 0.0;
  Eigen::VectorXd initial_, state_, next_;
  // Friction torque fed forward: of the steady motion, of the command computed last and of the one
  // before, which acted on the torque that is measured.
  double initial_friction_ = 0.0, friction_ = 0.0, built_friction_ = 0.0;
};

}  // namespace boresight::control
