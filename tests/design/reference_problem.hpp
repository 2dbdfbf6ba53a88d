#pragma once

#include "reference_antenna.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::reference {

/// The reference antenna in a wind of 10 m/s.
inline design::TrackingProblem tracking_problem(double disks = 24.0) {
  design::TrackingProblem problem;
  problem.plant = antenna(disks);
  problem.gear_ratio = gear_ratio();
  problem.delay = 0.03;
  problem.noise = {0.1 * mdeg * gear_ratio(), 0.02, 25.0};
  problem.wind = {wind_site(), plant::WindModel::coherence, 10.0};
  return problem;
}

/// A cautious controller, stable on the reference antenna.
inline control::Controller cautious_gains() {
  return {control::LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
}

/// From the position command, which enters as the negative of the encoder's noise does, to the
/// encoder.
inline plant::StateSpace command_to_encoder(const design::TrackingProblem& problem,
                                            const control::Controller& controller) {
  plant::StateSpace loop = control::closed_loop(problem.plant, controller, problem.delay);
  const auto input = plant::input_index(loop, "encoder_noise");
  const auto output = plant::output_index(loop, "encoder");
  loop.b = Eigen::MatrixXd(-loop.b.col(input));
  loop.c = Eigen::MatrixXd(loop.c.row(output));
  loop.d = Eigen::MatrixXd(-loop.d.block(output, input, 1, 1));
  loop.inputs = {"command"};
  loop.outputs = {"encoder"};
  return loop;
}

}  // namespace boresight::reference
