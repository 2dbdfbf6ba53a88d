#pragma once

#include <Eigen/Core>

namespace boresight::plant {

/// x' = f(t, x), with all that an implicit integrator wants to know of it. t in s.
///
/// Output arguments have the right shape when passed. The functions may be called for states
/// slightly off the solution, in any order, and at a t just behind an event or the end of an
/// interval. A system whose equations change at a time or an event must keep the present equations
/// for all arguments. The integrator's owner switches the system and restarts the integrator. A
/// value that is not finite makes the integrator try a smaller step. Exceptions leave its advance()
/// unchanged.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  /// Length of x.
  virtual Eigen::Index states() const = 0;

  /// dx = f(t, x).
  virtual void rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> dx) const = 0;

  /// j = df/dx, states x states; comes zeroed. An error in it costs steps, not accuracy, except
  /// where sensitivities are asked for: they are wrong then.
  virtual void jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                        Eigen::Ref<Eigen::MatrixXd> j) const = 0;

  /// How many functions g(t, x) stop the integrator where they change their sign.
  virtual Eigen::Index events() const { return 0; }

  /// g(t, x), of length events().
  virtual void event_values(double /*t*/, const Eigen::Ref<const Eigen::VectorXd>& /*x*/,
                            Eigen::Ref<Eigen::VectorXd> g) const {
    g.setZero();
  }

  /// How many parameters p the sensitivities dx/dp are taken for.
  virtual Eigen::Index parameters() const { return 0; }

  /// df_dp = df/dp at fixed x, states x parameters; comes zeroed.
  virtual void rate_by_parameters(double /*t*/, const Eigen::Ref<const Eigen::VectorXd>& /*x*/,
                                  Eigen::Ref<Eigen::MatrixXd> df_dp) const {
    df_dp.setZero();
  }
};

}  // namespace boresight::plant
