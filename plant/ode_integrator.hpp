#pragma once

#include <limits>
#include <memory>

#include <Eigen/Core>

#include <boresight/plant/ode_system.hpp>

namespace boresight::plant {

/// bdf: backward differentiation of order 1 to 5, for stiff systems. adams: Adams-Moulton of order
/// 1 to 12, for smooth ones whose fastest time constants are all of interest. Both are implicit and
/// solved by Newton's method with the system's Jacobian.
enum class OdeMethod { bdf, adams };

/// What advance(t) does with the step that would go past t: take it and interpolate back, which is
/// cheapest, or shorten it to end at t, which is needed where the system must not be asked for
/// times behind t because an input jumps there.
enum class Approach { interpolate, stop_exactly };

struct OdeOptions {
  /// The local error of each step is held below relative_tolerance |x_i| + absolute_tolerance_i in
  /// the root mean square over the states; the error of the solution is usually some ten times
  /// larger, more over many oscillations.
  double relative_tolerance = 1e-6;
  /// One for each state, in its unit, or a single one for all.
  Eigen::VectorXd absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-9);
  OdeMethod method = OdeMethod::bdf;
  /// s. Shorter than twice the shortest excursion of an event function that must not be missed:
  /// events are seen by the signs at the ends of a step only.
  double longest_step = std::numeric_limits<double>::infinity();
  /// Cap on the steps of each advance().
  long most_steps = 10'000'000;
  /// Also integrate s = dx/dp by s' = (df/dx) s + df/dp, under error control like the states.
  bool sensitivities = false;
  /// states x parameters, of the initial state; empty: zero.
  Eigen::MatrixXd initial_sensitivities;
  /// Typical size of each parameter, above 0: the absolute tolerance of dx_i/dp_k is that of x_i
  /// divided by it. Empty: 1 for all.
  Eigen::VectorXd parameter_scale;
};

/// Where advance() stopped.
struct OdeStop {
  double time = 0.0;   // s
  bool event = false;  // at an event, else at the time asked for
  /// For each event function -1 where it stopped the integrator falling, +1 rising, else 0.
  Eigen::VectorXi directions;
};

/// Work done since the construction, restarts included.
struct OdeStatistics {
  long steps = 0;
  long rate_evaluations = 0;
  long jacobians = 0;  // for the Newton iteration
  long sensitivity_evaluations = 0;
  long error_test_failures = 0;
};

/// An initial value problem, integrated forward with variable order and step by CVODES (A. C.
/// Hindmarsh et al., ACM Trans. Mathematical Software 31(3), 2005; R. Serban, A. C. Hindmarsh,
/// ASME IDETC 2005), with events and forward sensitivities. The same calls give the same bits.
class OdeIntegrator {
 public:
  /// At t0 with x0. Keeps a reference to `system`, which must outlive it; what the system does may
  /// change between calls if restart() follows, its sizes may not.
  /// @throws InvalidInput for an x0 of other length than system.states() or not finite, tolerances
  /// that are not finite, negative or all zero for a state, absolute tolerances neither 1 nor
  /// states() in number, a longest_step or most_steps not above 0, sensitivities without
  /// parameters, initial sensitivities or parameter scales of a wrong size or value.
  OdeIntegrator(const OdeSystem& system, double t0, const Eigen::VectorXd& x0,
                const OdeOptions& options = {});
  ~OdeIntegrator();
  OdeIntegrator(OdeIntegrator&& other) noexcept;
  OdeIntegrator& operator=(OdeIntegrator&& other) noexcept;
  OdeIntegrator(const OdeIntegrator&) = delete;
  OdeIntegrator& operator=(const OdeIntegrator&) = delete;

  /// Integrates to t (s) exactly, or to the first event before or at it. An event is located to
  /// some 100 roundings of t and reported on its far side or exactly at zero; one that is zero at
  /// the start does not fire there. An advance that throws leaves time() and state() where they
  /// were, and the next one starts anew from there.
  /// @throws InvalidInput for a t behind time() or not finite; whatever the system threw;
  /// NumericalFailure with the reason, the time and a remedy: too many steps, no convergence with
  /// the smallest step, tolerances beyond rounding, values that are not finite (names the function,
  /// its time and index) for every step however small, or at once if of an event function.
  OdeStop advance(double t, Approach approach = Approach::interpolate);

  /// s; that of the last stop.
  double time() const;
  const Eigen::VectorXd& state() const;
  /// dx/dp, states x parameters; without elements unless asked for. Across an event that depends on
  /// the state or parameters they are those of the law before it: the jump is the caller's to
  /// apply.
  const Eigen::MatrixXd& sensitivities() const;

  /// Forgets the past of the solution: after a jump of the state, an input or the law of the
  /// system. At time() with the present state, another one, or also other sensitivities. An event
  /// just located is kept from firing again by a state for which it is exactly zero.
  /// @throws InvalidInput for wrong sizes or elements that are not finite.
  void restart();
  void restart(const Eigen::VectorXd& x);
  void restart(const Eigen::VectorXd& x, const Eigen::MatrixXd& sensitivities);

  OdeStatistics statistics() const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace boresight::plant
