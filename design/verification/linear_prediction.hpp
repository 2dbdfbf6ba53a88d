#pragma once

#include <Eigen/Core>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// What the linear loop of a problem with a controller predicts of a simulation, by frequency
/// responses (control::LoopEvaluator).

/// |boresight / wind torque|^2 (rad^2/(N m)^2 at the motor) at frequencies (rad/s, above 0,
/// rising). @throws as those.
Eigen::ArrayXd wind_transmission(const TrackingProblem& problem,
                                 const control::Controller& controller,
                                 const Eigen::ArrayXd& frequency);

/// Boresight rms (rad of motor) in the problem's wind and noise. The loop must be stable, which is
/// not tested here. @throws as those.
double predicted_rms(const TrackingProblem& problem, const control::Controller& controller);

/// Boresight error (rad at the sky, magnitude) at rest in the problem's mean wind: the static
/// flexure of the structure, and what the loop's finite static stiffness adds or, with compliance
/// compensation, takes off. By the response at 3e-5 rad/s, to some 1e-4. @throws as
/// wind_transmission.
double static_boresight_error(const TrackingProblem& problem,
                              const control::Controller& controller);

/// Encoder error (rad at the sky, magnitude) at rest in the problem's mean wind, less what
/// compliance compensation moves the encoder by: the leakage flow that holds the mean torque, over
/// control::static_encoder_gain.
double static_encoder_error(const TrackingProblem& problem, const control::Controller& controller);

}  // namespace boresight::design
