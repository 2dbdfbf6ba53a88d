#pragma once

#include <functional>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/integration/ode_system.hpp>

namespace boresight::plant {

/// A linear system with nonlinear channels as an ordinary differential equation,
///   dx/dt = A x + B u(t) + G n(C x + D u(t)),
/// with its Jacobian A + G dn/dz C: the very system that FastIntegrator integrates, for an
/// integrator of another kind. Not for several threads at once.
class FeedbackOde final : public OdeSystem {
 public:
  /// Writes u(t). Continuous with its derivative between restarts of the integrator.
  using Input = std::function<void(double t, Eigen::Ref<Eigen::VectorXd> u)>;

  /// No inputs yet: u = 0. @throws InvalidInput as feedback_matrices.
  explicit FeedbackOde(const FeedbackSystem& system);

  /// From now on u(t). Restart the integrator after it.
  void drive(Input input) { input_ = std::move(input); }
  /// From now on straight through u0 at t0 and u1 at t1, and on beyond them; held if u0 = u1. For a
  /// sampled record: piece after piece. @throws InvalidInput for lengths that do not fit, elements
  /// that are not finite and t1 = t0.
  void drive(double t0, const Eigen::VectorXd& u0, double t1, const Eigen::VectorXd& u1);

  Eigen::Index states() const override { return matrices_.a.rows(); }
  void rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
            Eigen::Ref<Eigen::VectorXd> dx) const override;
  void jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::MatrixXd> j) const override;

  /// y at t.
  Eigen::VectorXd outputs(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const;

 private:
  void evaluate(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const;

  FeedbackMatrices matrices_;
  std::shared_ptr<const NonlinearChannels> channels_;
  Input input_;
  mutable Eigen::VectorXd u_, z_, n_;
  mutable Eigen::MatrixXd slope_;
};

}  // namespace boresight::plant
