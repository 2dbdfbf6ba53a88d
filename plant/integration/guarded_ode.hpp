#pragma once

#include <exception>
#include <string>

#include <Eigen/Core>

#include <boresight/plant/integration/ode_system.hpp>

namespace boresight::plant {

/// An OdeSystem as an integrator in C may call it. No exception passes: every call has a verdict, 0
/// if the values are good, `smaller_step` if one is not finite, and `give_up` if the system threw
/// or no smaller step can help. What happened is kept until it is asked for.
class GuardedOde {
 public:
  static constexpr int smaller_step = 1;
  static constexpr int give_up = -1;

  /// Keeps the reference.
  explicit GuardedOde(const OdeSystem& system) : system_(system) {}

  const OdeSystem& system() const { return system_; }

  /// The integrator starts at t: nothing is accepted yet.
  void start(double t);

  /// dx = f(t, x) when so many steps have been accepted since the start; the last of them ended
  /// where the rate was asked for last. Gives up when the time has long not moved.
  int rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> dx,
           long accepted_steps);
  /// j, and also df_dp below, must come zeroed.
  int jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> j);
  int rate_by_parameters(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                         Eigen::Ref<Eigen::MatrixXd> df_dp);
  int event_values(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                   Eigen::Ref<Eigen::VectorXd> g);

  /// Throws again what the system threw since the last call of this, if it did.
  void rethrow();
  /// What was wrong with the last values, in words; empty if nothing was.
  const std::string& complaint() const { return complaint_; }

 private:
  template <class Evaluate>
  int classify(const char* function, double t, const Eigen::Ref<const Eigen::MatrixXd>& values,
               const Evaluate& evaluate);
  bool stands_still(double t, long accepted_steps);
  bool within_rounding(double t) const;

  const OdeSystem& system_;
  double asked_ = 0.0;     // time of the last rate
  double accepted_ = 0.0;  // end of the last accepted step
  long accepted_steps_ = 0;
  int standing_ = 0;  // accepted steps in a row that did not move the time
  std::exception_ptr thrown_;
  std::string complaint_;
};

}  // namespace boresight::plant
