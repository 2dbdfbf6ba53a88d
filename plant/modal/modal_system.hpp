#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// Vibration modes with mass-normalised shapes, as a finite-element program or a modal test gives
/// them, seen through a few ports:
///   eta_i'' + 2 zeta_i w_i eta_i' + w_i^2 eta_i = sum_k force_shape(i, k) F_k
///   displacement_j = sum_i displacement_shape(j, i) eta_i
/// A mode of frequency 0 is a free motion.
struct VibrationModes {
  Eigen::VectorXd frequency;           // rad/s
  Eigen::VectorXd damping_ratio;       // of critical
  Eigen::MatrixXd force_shape;         // modes x forces
  Eigen::MatrixXd displacement_shape;  // displacements x modes
  /// Names: each force is an output of the core; each displacement, and its rate, an input of the
  /// core, or empty where the core does not use it.
  std::vector<std::string> forces;
  std::vector<std::string> displacements;
  std::vector<std::string> rates;
};

/// An exact dead time from a core output to a core input.
struct DeadTime {
  std::string from;
  std::string to;
  double delay = 0.0;  // s
};

/// A small dense core (drive, controllers, shaping filters) with any number of vibration modes and
/// dead times around it. What is asked of it costs O(modes), never O(modes^3).
struct ModalSystem {
  StateSpace core;  // continuous
  VibrationModes modes;
  std::vector<DeadTime> dead_times;
  std::vector<std::string> inputs;   // from outside, among the core's inputs
  std::vector<std::string> outputs;  // to outside, among the core's outputs
};

/// @throws InvalidInput naming the first defect: shapes that do not fit, values that are not
/// finite, a negative frequency, damping or delay, a port the core has not, an input of the core
/// that nothing or more than one thing feeds, a sampled core.
void validate(const ModalSystem& system);

/// A dense system as one without modes, all its inputs and outputs to outside.
ModalSystem without_modes(const StateSpace& system);

/// The whole as one dense state space of (core + 2 modes) states: mode i as `mode.i` and
/// `mode.i.rate` (i from 1).
/// @throws InvalidInput as validate, or if there is a dead time: it has no finite state space (see
/// control::delay_approximant); NumericalFailure for an algebraic loop without solution.
StateSpace to_state_space(const ModalSystem& system);

}  // namespace boresight::plant
