#pragma once

#include <complex>
#include <numbers>

#include "design/reference_problem.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

/// Closed-loop answer to a torque on the motors, at one frequency (rad/s), exact dead time.
struct LoadResponse {
  std::complex<double> motor_rate;  // rad/s per N m
  std::complex<double> encoder;     // rad per N m
};

inline LoadResponse load_response(const design::TrackingProblem& problem,
                                  const control::Controller& controller, double frequency) {
  auto plant = plant::to_state_space(problem.plant);
  Eigen::Index motor = 0;
  while (plant.states[static_cast<std::size_t>(motor)] != "motor_rate") ++motor;
  const Eigen::Index n = plant.a.rows();
  plant.inputs.emplace_back("load");
  plant.b.conservativeResize(n, 3);
  plant.b.col(2).setZero();
  plant.b(motor, 2) = 1.0 / problem.plant.drive.motor_inertia;
  plant.outputs.emplace_back("motor_rate");
  plant.c.conservativeResize(5, n);
  plant.c.row(4).setZero();
  plant.c(4, motor) = 1.0;
  plant.d = Eigen::MatrixXd::Zero(5, 3);
  const auto g = plant::frequency_response(plant, frequency);
  const auto controller_at = control::compensator_response(controller, frequency);
  const auto delay = std::polar(1.0, -frequency * problem.delay);
  // Valve command from tachometer (0) and encoder (2).
  const auto answer = [&](Eigen::Index column) {
    return delay * controller_at.rate * (g(0, column) + controller_at.position * g(2, column));
  };
  const std::complex<double> command = -answer(2) / (1.0 + answer(0));
  return {g(4, 2) + g(4, 0) * command, g(2, 2) + g(2, 0) * command};
}

/// What the describing function 4 Fc/(pi A) of Coulomb friction predicts: the frequency at which
/// the answer of the motor's rate to a torque is real and negative, and the encoder's amplitude.
struct PredictedCycle {
  double frequency = 0.0;          // Hz
  double encoder_amplitude = 0.0;  // rad of motor
};

inline PredictedCycle predicted_cycle(const design::TrackingProblem& problem,
                                      const control::Controller& controller, double coulomb,
                                      double lower, double upper) {
  const auto imaginary = [&](double hertz) {
    return load_response(problem, controller, two_pi * hertz).motor_rate.imag();
  };
  const bool rises = imaginary(upper) > 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lower + upper);
    ((imaginary(middle) > 0.0) == rises ? upper : lower) = middle;
  }
  const auto there = load_response(problem, controller, two_pi * lower);
  return {lower, 4.0 * coulomb / std::numbers::pi * std::abs(there.encoder)};
}

}  // namespace boresight::reference
