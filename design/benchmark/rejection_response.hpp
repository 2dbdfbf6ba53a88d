#pragma once

#include <array>

#include <Eigen/Core>

#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Poles (rad/s) of an antenna with a state-space controller. For a continuous controller the dead
/// time is a rational function of order 8; for a sampled one the poles are ln(z)/T.
Eigen::VectorXcd controlled_poles(const plant::AntennaPlant& plant,
                                  const plant::StateSpace& controller, double delay);

/// The response of a controlled antenna at quadrature points over ln f. There are three Gauss
/// points between neighbours of a grid that resolves every lightly damped pole of plant and closed
/// loop.
struct RejectionResponse {
  Eigen::ArrayXd frequency;     // rad/s
  Eigen::ArrayXd wind_weight;   // sum over the points with it: an integral over Hz in the band
  Eigen::ArrayXd noise_weight;  // the same over the sensors' noise: to its bandwidth, or to the
                                // Nyquist frequency of a sampled controller
  Eigen::ArrayXd boresight_by_wind_square;
  std::array<Eigen::ArrayXd, 3> sensitivity;  // |S|, NaN where there is no such loop
  double noise_variance = 0.0;                // rad^2 of motor
  double effort_variance = 0.0;               // (rad/s)^2

  /// Ms at a break, by a parabola between the points.
  double peak(std::size_t loop_break) const;
};

RejectionResponse rejection_response(const TrackingProblem& problem,
                                     const plant::StateSpace& controller);

/// Boresight rms (rad of motor) in the problem's wind by Lyapunov equations. The wind is modelled
/// by its shaping filter, over all frequencies. A continuous controller's dead time is rational; a
/// sampled controller's loop is exact. @throws NumericalFailure if the loop is not stable.
double rejection_lyapunov_rms(const TrackingProblem& problem, const plant::StateSpace& controller);

}  // namespace boresight::design
