#pragma once

#include <limits>

#include <Eigen/Core>

#include <boresight/plant/integration/ode_system.hpp>

namespace boresight::plant {

/// bdf: backward differentiation of order 1 to 5, for stiff systems. adams: Adams-Moulton of order
/// 1 to 12, for smooth ones whose fastest time constants are all of interest. Both are implicit.
enum class OdeMethod { bdf, adams };

/// How the implicit equation of a step is solved. newton: with the system's Jacobian, whatever the
/// stiffness. fixed_point: from the rate alone, without Jacobian or linear equations; several times
/// as fast where the steps are no longer than the shortest time constant, far slower where they
/// could be.
enum class OdeIteration { newton, fixed_point };

struct OdeOptions {
  /// The local error of each step is held below relative_tolerance |x_i| + absolute_tolerance_i in
  /// the root mean square over the states; the error of the solution is usually some ten times
  /// larger, more over many oscillations.
  double relative_tolerance = 1e-6;
  /// One for each state, in its unit, or a single one for all.
  Eigen::VectorXd absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-9);
  OdeMethod method = OdeMethod::bdf;
  OdeIteration iteration = OdeIteration::newton;  // fixed_point: without sensitivities only
  /// The method's own limit also holds. Only bdf up to order 2 is stable however long its steps
  /// against a mode that hardly decays: 2 takes fewer steps where such modes are not excited and
  /// the tolerances loose (1e-4: up to seven times fewer), more where they are tight.
  int highest_order = 12;
  /// s. Events are seen by the signs of their functions at the ends of a step: shorter than the
  /// shortest change of sign and back that must not be missed.
  double longest_step = std::numeric_limits<double>::infinity();
  /// Cap on the steps of each advance().
  long max_steps = 10'000'000;
  /// Also integrate s = dx/dp by s' = (df/dx) s + df/dp, under error control like the states.
  bool sensitivities = false;
  /// states x parameters, of the initial state; empty: zero.
  Eigen::MatrixXd initial_sensitivities;
  /// Typical size of each parameter, above 0: the absolute tolerance of dx_i/dp_k is that of x_i
  /// divided by it. Empty: 1 for all.
  Eigen::VectorXd parameter_scale;
};

/// @throws InvalidInput for a relative tolerance outside [0, 1), absolute tolerances not above 0 or
/// neither 1 nor system.states() in number, a highest_order, longest_step or max_steps not above
/// 0, and if sensitivities are asked for: by fixed-point iteration, of a system without parameters,
/// initial sensitivities or parameter scales of a wrong shape or not finite, a scale not above 0.
void validate(const OdeOptions& options, const OdeSystem& system);

}  // namespace boresight::plant
