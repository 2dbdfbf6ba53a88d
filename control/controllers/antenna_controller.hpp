#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/nonlinear/sampled_controller.hpp>

namespace boresight::control {

/// What the commanded motion adds to rate command and valve command, beside what the law answers to
/// errors. All zero: none.
struct Feedforward {
  double rate_to_rate_command = 0.0;           // 1
  double acceleration_to_rate_command = 0.0;   // s
  double rate_to_valve_command = 0.0;          // 1
  double acceleration_to_valve_command = 0.0;  // s
};

/// The feedforward under which a plant moves with its command by itself, so that the law sees no
/// error, to the second order of the motion (rigid antenna, no jerk). With the plant's equations
/// (antenna_plant.hpp) at rate w and acceleration a, T = J a + Bf w:
///   valve     u(t) = xv + 2 zv/wv xv',  xv = w + (T' + lambda T)/K = (1 + lambda Bf/K) w
///                    + (lambda J + Bf)/K a,
///             a `delay` earlier (s, all of it: computation and half a hold), and what a pressure
///             path takes off, Q'(0) T' = Q'(0) Bf a
///   tachometer w - a/(its corner), which the rate command has to be for the rate error to be 0.
/// The first of either is the inverse of the plant's response at low frequencies, as in M.
/// Tomizuka, Zero phase error tracking algorithm, J. Dyn. Syst. Meas. Control 109, 1987, for slow
/// commands. Dry friction is not in it. @throws InvalidInput as validate(law), and for a delay that
/// is negative or not finite.
Feedforward plant_feedforward(const plant::AntennaPlant& plant, const ControlLaw& law,
                              double delay);

/// The steady motion that a controller takes over.
struct SteadyMotion {
  double valve_command = 0.0;  // rad/s
  double tachometer = 0.0;     // rad/s
  double motor_torque = 0.0;   // N m
};

struct AntennaControllerOptions {
  Feedforward feedforward = {};
  /// Largest magnitude of the valve command (rad/s).
  double command_limit = std::numeric_limits<double>::infinity();
  /// Whether integrators are kept from winding up while the command is at its limit.
  bool anti_windup = true;
};

/// A control law as the antenna's computer runs it: sampled (sampled_law), with feedforward, and
/// with its valve command held within limits. Reads tachometer, encoder, motor_torque (only if the
/// law feeds it back), then the references reference (rad), reference_rate (rad/s),
/// reference_acceleration (rad/s2, until the next sample), all of motor; drives valve_command. The
/// time that the computation takes is the simulation's (SimulationPlan::computation_delay).
///
/// Anti-windup by back calculation (K. J. Astrom, T. Hagglund, PID Controllers, 1995, ch. 3.5) at
/// the angle: what the limit takes off the command, over the product of the proportional gains of
/// rate and position path, is taken off the reference that the law's states see. This is the
/// reference that the antenna could have followed (R. Hanus, M. Kinnaert, J.-L. Henrotte,
/// Conditioning technique, Automatica 23, 1987), and one injection unwinds both integrators: at the
/// limit the states of a PI-PI law move with 2 s^2 + (wi + wip) s + wi wip = 0 in place of s^2 = 0.
/// It is halved until the states at the limit are stable.
class AntennaController final : public plant::SampledController {
 public:
  /// @throws InvalidInput as sampled_law, for a command limit that is not above 0, and feedforward
  /// that is not finite.
  AntennaController(const ControlLaw& law, double sample_time,
                    const AntennaControllerOptions& options = {});

  double sample_time() const override { return sample_time_; }
  const std::vector<std::string>& inputs() const override { return inputs_; }
  const std::vector<std::string>& outputs() const override { return outputs_; }
  void restart() override { state_ = initial_; }
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override;

  /// From restart() on the law begins as if it had held this motion for ever, the reference rate
  /// that of the tachometer. Returns the encoder's lead over the reference (rad) that goes with it:
  /// 0 for a law that integrates the angle, but for what compliance compensation adds.
  /// @throws NumericalFailure for a law that cannot hold a motion steadily.
  double start_from(const SteadyMotion& motion);

  /// The share of back calculation in use: 1, 1/2, ...; 0 without anti-windup or integrators.
  double back_calculation_share() const { return back_calculation_share_; }

 private:
  double sample_time_;
  AntennaControllerOptions options_;
  bool reads_torque_ = false;
  std::vector<std::string> inputs_, outputs_;
  // Inputs: tachometer, encoder less reference, rate command's feedforward, torque.
  Eigen::MatrixXd a_, b_;
  Eigen::RowVectorXd c_, d_;
  Eigen::VectorXd back_calculation_;
  double back_calculation_share_ = 0.0;
  Eigen::VectorXd initial_, state_, next_;
};

}  // namespace boresight::control
