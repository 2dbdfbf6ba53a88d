#pragma once

#include <memory>

#include <Eigen/Core>

#include <boresight/plant/integration/nonlinear_channels.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// A linear system with a few nonlinear channels in feedback,
///   dx/dt = A x + B u + G n(z),   z = C x + D u,   y = Cy x + Dy u + Ey n(z).
struct FeedbackSystem {
  /// Inputs: u first, then the channels' outputs n. Outputs: the channels' inputs z first, then
  /// what is observed, y. Continuous; n does not reach z without passing a state.
  StateSpace linear;
  Eigen::Index channel_outputs = 0;                   // q, the number of n
  Eigen::Index channel_inputs = 0;                    // p, the number of z
  std::shared_ptr<const NonlinearChannels> channels;  // none if q = p = 0
};

/// The matrices of a feedback system, taken apart.
struct FeedbackMatrices {
  Eigen::MatrixXd a;                   // states x states
  Eigen::MatrixXd input;               // B: states x inputs u
  Eigen::MatrixXd channel_input;       // G: states x q
  Eigen::MatrixXd channel_output;      // C: p x states
  Eigen::MatrixXd input_to_channels;   // D: p x inputs u
  Eigen::MatrixXd output;              // Cy: observed x states
  Eigen::MatrixXd input_to_output;     // Dy: observed x inputs u
  Eigen::MatrixXd channels_to_output;  // Ey: observed x q
};

/// @throws InvalidInput as validate(linear), for a sampled system, more channels than the linear
/// system has inputs or outputs, channels that are missing or of other sizes, and a path from n to
/// z that passes no state.
FeedbackMatrices feedback_matrices(const FeedbackSystem& system);

}  // namespace boresight::plant
