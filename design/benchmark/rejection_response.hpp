#pragma once

#include <array>

#include <Eigen/Core>

#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Poles of an antenna under a state-space controller (rad/s): with its dead time as a rational
/// function of order 8, or, of a sampled one, as ln(z)/T.
Eigen::VectorXcd controlled_poles(const plant::AntennaPlant& plant,
                                  const plant::StateSpace& controller, double delay);

/// The response of a controlled antenna at points of a quadrature over ln f: three of Gauss between
/// neighbours of a grid that follows every lightly damped pole of plant and closed loop.
struct RejectionResponse {
  Eigen::ArrayXd frequency;     // rad/s
  Eigen::ArrayXd wind_weight;   // a sum over the points with it is an integral over Hz in the band
  Eigen::ArrayXd noise_weight;  // the same over the sensors' noise: to its bandwidth, or to the
                                // Nyquist frequency of a sampled controller
  Eigen::ArrayXd beam_by_wind_square;
  std::array<Eigen::ArrayXd, 3> sensitivity;  // |S|, not a number where there is no such loop
  double noise_variance = 0.0;                // rad^2 of motor
  double effort_variance = 0.0;               // (rad/s)^2

  /// Largest |S| at a break, by a parabola between the points.
  double peak(std::size_t loop_break) const;
};

RejectionResponse rejection_response(const TrackingProblem& problem,
                                     const plant::StateSpace& controller);

/// Beam rms (rad of motor) at the problem's wind by Lyapunov equations: the wind through its
/// shaping filter, over all frequencies; a continuous controller's dead time rational, a sampled
/// controller's loop exact. @throws NumericalFailure if the loop is not stable.
double rejection_lyapunov_rms(const TrackingProblem& problem, const plant::StateSpace& controller);

}  // namespace boresight::design
