#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/integration/exponential_collocation.hpp>
#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/integration/stage_solver.hpp>
#include <boresight/plant/linear/modal_form.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::plant {

struct FastIntegratorOptions {
  /// Between the samples of the inputs and outputs (s). Steps are this, 1/2, 1/4, ... of it.
  double interval = 0.0;
  /// The shortest step is interval/2^finest_rung. 0..30.
  int finest_rung = 20;
  /// Largest error that a step makes in the channels' inputs z, at its end or up to an interval
  /// later: absolute + relative |z|.
  double relative_tolerance = 1e-6;
  /// One for each channel input, in its unit, or one for all: far below the size at which that
  /// input matters (a bristle deflects by micrometres).
  Eigen::VectorXd absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-8);
  /// As in SimulationOptions: above it a dense transition matrix takes the place of the modes.
  double largest_condition = highest_modal_condition;
};

/// Work done since the construction.
struct FastIntegratorStatistics {
  long long steps = 0;     // accepted
  long long rejected = 0;  // for their error or because Newton's method did not converge
  long long newton_iterations = 0;
  int finest_rung = 0;  // the shortest step taken was interval/2^finest_rung
};

/// Integrates a linear system with nonlinear channels: the linear part (modes, oil lines, filters)
/// exactly, whatever the step, the channels implicitly by exponential collocation at the three
/// Radau IIA points (order 5, stiffly accurate; M. Hochbruck, A. Ostermann, Exponential
/// Runge-Kutta methods for parabolic problems, Appl. Numer. Math. 53, 2005; E. Hairer, G. Wanner,
/// Solving Ordinary Differential Equations II, IV.5). Steps are as long as the channels allow, not
/// the modes. Inputs are straight within an interval and may jump between intervals.
///
/// Step sizes follow an estimate of each step's error: the next term of the channels' polynomial,
/// from their values at the start of the step, and what a kink of a channel within the step may
/// add, from the slopes dn/dz; wrong slopes therefore cost steps, not accuracy.
class FastIntegrator {
 public:
  /// At rest at t = 0. O(n^3) once; then O(n) a step by modes or O(n^2) by the dense route.
  /// @throws InvalidInput as feedback_matrices and for options out of range; NumericalFailure if
  /// the linear part overflows within one interval.
  FastIntegrator(const FeedbackSystem& system, FastIntegratorOptions options);

  /// Everything before is forgotten. @throws InvalidInput for a wrong length or elements that are
  /// not finite.
  void start_from(const Eigen::VectorXd& state, double time = 0.0);

  /// One interval, the inputs straight from `u_start` to `u_end`. Allocates nothing once it has
  /// taken steps of the length it takes. @throws InvalidInput for inputs that do not fit or are not
  /// finite; NumericalFailure, with time and channel, for a channel that is not finite and where
  /// the shortest step is still too long, and for an overflow: only start_from leads on then.
  void advance(const Eigen::Ref<const Eigen::VectorXd>& u_start,
               const Eigen::Ref<const Eigen::VectorXd>& u_end);

  /// A record: y at the end of each interval, intervals x outputs. Zero-order hold: row k of
  /// `input` (intervals x inputs) is held throughout interval k, and y is that just before the
  /// input changes. First-order hold: straight from row k to row k + 1 (intervals + 1 rows).
  /// @throws as advance, and InvalidInput for shapes that do not fit.
  void simulate(const Eigen::Ref<const Eigen::MatrixXd>& input, Eigen::Ref<Eigen::MatrixXd> output,
                Interpolation interpolation = Interpolation::zero_order_hold);

  // At the end of the last interval; outputs and channels are zero before the first one.
  double time() const { return time_; }                              // s
  Eigen::VectorXd state() const;                                     // x
  const Eigen::VectorXd& outputs() const { return y_; }              // y, before the inputs jump
  const Eigen::VectorXd& channel_inputs() const { return now_.z; }   // z
  const Eigen::VectorXd& channel_outputs() const { return now_.n; }  // n
  const FastIntegratorStatistics& statistics() const { return statistics_; }
  /// Whether the linear part is integrated by modes.
  bool by_modes() const { return collocation_.by_modes(); }

 private:
  enum class Refusal { none, error, divergence, not_finite, overflow };

  const CollocationStep& rung(int index);
  void begin_interval(const Eigen::Ref<const Eigen::VectorXd>& u_start);
  Refusal attempt(const CollocationStep& step);
  void accept(const CollocationStep& step);
  void extrapolate(double length);
  double error_of(const CollocationStep& step);
  [[noreturn]] void give_up(Refusal refusal, double time);

  FastIntegratorOptions options_;
  ExponentialCollocation collocation_;
  StageSolver solver_;
  std::vector<std::string> channel_names_, channel_input_names_;
  std::vector<std::optional<CollocationStep>> rungs_;
  FastIntegratorStatistics statistics_;
  double time_ = 0.0;
  double interval_start_ = 0.0;
  long long intervals_ = 0;  // since interval_start_
  int rung_ = 0;
  int jump_rung_ = 0;             // that of the first step after the last jump
  int hold_off_ = 0;              // steps before a longer one is tried again
  double error_ = 0.0;            // of the last step, 1 is allowed
  Eigen::Index worst_input_ = 0;  // of which that is
  bool known_ = false;            // whether now_ belongs to the present state
  bool failed_ = false;
  double past_length_ = 0.0;  // of the step whose values past_ holds; 0: none
  std::array<std::array<double, collocation_stages>, collocation_stages> extrapolation_{};
  double extrapolation_ratio_ = 0.0;  // of the new step to the last, for those weights
  Eigen::VectorXd start_;             // [v; u at the start of the step; at its end]
  Eigen::VectorXd drive_;             // [both u; n at the stages]
  Eigen::VectorXd scratch_, free_, stages_, past_, scale_;
  StageValues now_;
  Eigen::VectorXd y_, u_end_, u_from_, u_to_;
};

}  // namespace boresight::plant
