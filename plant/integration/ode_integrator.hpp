#pragma once

#include <memory>

#include <Eigen/Core>

#include <boresight/plant/integration/ode_options.hpp>
#include <boresight/plant/integration/ode_system.hpp>

namespace boresight::plant {

/// Treatment by advance(t) of the step that would pass t. interpolate: take the step and
/// interpolate back, which is cheapest. stop_exactly: shorten the step to end at t, needed if an
/// input jumps there and the system must not be evaluated beyond t.
enum class Approach { interpolate, stop_exactly };

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
};

/// An initial value problem, integrated forward with variable order and step by CVODES (A. C.
/// Hindmarsh et al., ACM Trans. Mathematical Software 31(3), 2005; R. Serban, A. C. Hindmarsh,
/// ASME IDETC 2005), with events and forward sensitivities. The same calls give the same bits.
class OdeIntegrator {
 public:
  /// At t0 with x0. Keeps a reference to `system`, which must outlive it; what the system does may
  /// change between calls if restart() follows, its sizes may not.
  /// @throws InvalidInput for a t0 or x0 that is not finite, an x0 of other length than
  /// system.states(), and as validate(options, system).
  OdeIntegrator(const OdeSystem& system, double t0, const Eigen::VectorXd& x0,
                const OdeOptions& options = {});
  ~OdeIntegrator();
  OdeIntegrator(OdeIntegrator&& other) noexcept;
  OdeIntegrator& operator=(OdeIntegrator&& other) noexcept;
  OdeIntegrator(const OdeIntegrator&) = delete;
  OdeIntegrator& operator=(const OdeIntegrator&) = delete;

  /// Integrates to t (s) exactly, or to the first event before or at it. An event is located to
  /// some 100 roundings of t, and its function is on the far side there, or zero and counts as
  /// such: going back is an event again. An advance that throws leaves time() and state() where
  /// they were, and the next one starts anew from there.
  /// @throws InvalidInput for a t behind time() or not finite; whatever the system threw;
  /// NumericalFailure with the reason, the time and a remedy: too many steps, no convergence with
  /// the smallest step, tolerances beyond rounding, values that are not finite (names the function,
  /// its time and index) for every step however small, or at once if of an event function.
  OdeStop advance(double t, Approach approach = Approach::interpolate);

  /// s; that of the last stop.
  double time() const;
  const Eigen::VectorXd& state() const;
  /// dx/dp, states x parameters; empty unless requested. Across an event that depends on the state
  /// or parameters they belong to the equations before it; the caller must apply the jump.
  const Eigen::MatrixXd& sensitivities() const;

  /// Discards the history of the solution, for a jump of the state, of an input or of the system's
  /// equations. Restarts at time() with the present state, another one, or also other
  /// sensitivities. An event function that is exactly zero for another state does not fire there,
  /// nor as it leaves zero.
  /// @throws InvalidInput for wrong sizes or elements that are not finite.
  void restart();
  void restart(const Eigen::VectorXd& x);
  void restart(const Eigen::VectorXd& x, const Eigen::MatrixXd& sensitivities);

  OdeStatistics statistics() const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace boresight::plant
