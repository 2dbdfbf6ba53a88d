#pragma once

#include <array>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// One controller: a structure with its gains, each positive, in the order of gain_descriptions.
struct Controller {
  LoopStructure structure;
  std::vector<double> gains;
};

/// A state space as a controller (LoopStructure::of_state_space). @throws as of_state_space.
Controller state_space_controller(std::string name, const plant::StateSpace& controller);

/// A state-space controller with its output times a factor. @throws InvalidInput for a controller
/// with gains.
Controller with_output_times(double factor, const Controller& controller);

/// @throws InvalidInput for the wrong number of gains or one that is not positive and finite.
void validate(const Controller& controller);

/// The gain with that symbol. @throws InvalidInput if the structure has none.
double gain(const Controller& controller, std::string_view symbol);

/// Compensators at s = j w, and the logarithmic derivative of each compensator with respect to each
/// of its gains (d ln X/d ln g).
struct CompensatorResponse {
  std::complex<double> rate;        // R, rad/s of valve command per rad/s of rate error
  std::complex<double> pressure;    // Q, rad/s of valve command per N m; 0 where absent
  std::complex<double> position;    // P, rad/s of rate command per rad
  std::complex<double> compliance;  // C, rad per N m; 0 where absent
  std::array<std::complex<double>, max_gains> by_gain{};
};
/// Of a state space (LoopStructure::of_state_space): R and Q are its responses to tachometer and
/// torque and R P that to the encoder, each times -1; C is 0.
CompensatorResponse compensator_response(const Controller& controller, double angular_frequency);

/// Static gain (1/s) from the encoder's error to the valve demand, at rest. For loops it is the
/// product of the gains of rate and position path, infinite with an integral in either that takes
/// every error (a conditional one holds at rest); for a state space the static gain from encoder to
/// valve_demand, infinite with a pole at z = 1.
double static_encoder_gain(const Controller& controller);

/// The Nyquist frequency of a state space (rad/s); infinite for loops, which are continuous. Beyond
/// it the controller's response mirrors what is below, so that peaks and margins there are images.
double nyquist_frequency(const Controller& controller);

/// Ratio of two power spectral densities of a state space's command: of its samples, over that of
/// the held command, as compensator_response gives it. 1/hold_amplitude^2 up to the Nyquist
/// frequency, 0 beyond; 1 for loops. The control effort is the rms of the samples.
/// `angular_frequency`: rad/s, 0 or more.
double sample_density(const Controller& controller, double angular_frequency);

/// State space of the controller. Inputs: tachometer (rad/s), encoder (rad), motor_torque (N m;
/// only if the pressure or compliance path feeds it back), rate_disturbance (rad/s, added to the
/// rate command). Outputs: valve_demand (rad/s, before the dead time), rate_command. For a state
/// space: the continuous system from which Tustin's method gives the sampled one,
/// with_rate_command.
plant::StateSpace to_state_space(const Controller& controller);

/// The same with the position loop open: inputs tachometer, motor_torque (only with a pressure
/// path); output valve_demand.
plant::StateSpace rate_loop_controller(const Controller& controller);

/// The compliance path: input motor_torque (N m), output flexure (rad). @throws InvalidInput for a
/// controller without one.
plant::StateSpace compliance_compensator(const Controller& controller);

/// A state space with the ports of a controller with loops. It has no rate command; cut at its
/// encoder it has one in form, rate_command = rate_disturbance - (1/s) encoder.
plant::StateSpace with_rate_command(const plant::StateSpace& controller);

}  // namespace boresight::control
