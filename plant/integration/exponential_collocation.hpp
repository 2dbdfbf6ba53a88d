#pragma once

#include <array>
#include <complex>
#include <optional>

#include <Eigen/Core>

#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::plant {

/// phi_0(z) = e^z and phi_k(z) = integral of e^(z (1 - s)) s^(k-1)/(k-1)! over 0..1, k = 1..4:
/// to errors of some 2e-15 (1 + |Im z|/10) of the larger of |phi_k| and 1/((k - 1)! max(|z|, 1))
/// (M. Hochbruck, A. Ostermann, Acta Numerica 19, 2010, section 2.1). Not finite where e^z
/// overflows.
std::array<std::complex<double>, 5> phi_functions(std::complex<double> z);

/// The Radau IIA points of order 5 in 0..1, the last of them 1 (E. Hairer, G. Wanner, Solving
/// Ordinary Differential Equations II, IV.5).
inline constexpr int collocation_stages = 3;
inline constexpr std::array<double, collocation_stages> collocation_points{
    0.15505102572168219, 0.64494897427831781, 1.0};  // (4 -+ sqrt 6)/10, 1

/// The polynomial through values at the collocation points, and the one that is 1 at 0 and zero at
/// all of them, as coefficients of ascending powers of s = t/h: rows 0..2 the Lagrange polynomials,
/// row 3 the other.
Eigen::Matrix4d collocation_polynomials();

/// What a feedback system does in one step of a length h when the inputs are straight within the
/// step, from u0 to u1, and the channels' outputs are the quadratic polynomial through n1, n2, n3
/// at the collocation points. With the coordinates v of ExponentialCollocation:
///   [z1; z2; z3] = start_to_stages [v; u0; u1] + channels_to_stages [n1; n2; n3],
///   v(h) = exp(.. h) v + drive_to_end [u0; u1; n1; n2; n3].
struct CollocationStep {
  double length = 0.0;                 // h, s
  Eigen::MatrixXd start_to_stages;     // 3 p x (states + 2 inputs)
  Eigen::MatrixXd channels_to_stages;  // 3 p x 3 q
  Eigen::MatrixXd drive_to_end;        // states x (2 inputs + 3 q)
  /// What the stages see of errors in the channels' outputs: first of those that are 1 at the start
  /// of the step and zero at the collocation points (the polynomial of degree three), then of those
  /// that are 1 throughout: 3 p x 2 q.
  Eigen::MatrixXd error_to_stages;
  /// What n at the stages and such errors make of z one third of the horizon and one horizon behind
  /// the end of the step, all else at rest: 2 p x 3 q and 2 p x 2 q.
  Eigen::MatrixXd channels_to_later, error_to_later;
  /// By modes: real and imaginary parts of e^(pole h), the pairs first. Else without elements.
  Eigen::VectorXd factor_real, factor_imaginary;
  Eigen::MatrixXd transition;  // exp(A h), states x states; without elements by modes

  /// v <- exp(.. h) v. `scratch` has the length of v.
  void propagate(Eigen::Ref<Eigen::VectorXd> v, Eigen::Ref<Eigen::VectorXd> scratch) const;
};

/// The linear part of a feedback system, in coordinates v that make exact steps cheap: modes
/// (the real parts of all pairs, the real poles, the imaginary parts of the pairs), or x itself
/// where the eigenvectors are too nearly dependent.
class ExponentialCollocation {
 public:
  /// `horizon`: time (s) after a step over which its errors are evaluated; 0 or more.
  /// @throws InvalidInput as feedback_matrices and for an invalid horizon; NumericalFailure if the
  /// linear part overflows within it.
  ExponentialCollocation(const FeedbackSystem& system, double largest_condition,
                         double horizon = 0.0);

  /// O(states) times p q by modes, else O((states + 4 q + 4 inputs)^3).
  /// @throws InvalidInput unless h > 0; NumericalFailure if the transition overflows.
  CollocationStep step(double length) const;

  bool by_modes() const { return form_.has_value(); }
  const FeedbackMatrices& matrices() const { return matrices_; }
  Eigen::VectorXd to_coordinates(const Eigen::VectorXd& state) const;
  Eigen::VectorXd to_state(const Eigen::VectorXd& coordinates) const;
  const Eigen::MatrixXd& channel_output() const { return channel_output_; }  // v to z
  const Eigen::MatrixXd& output() const { return output_; }                  // v to y

 private:
  void look_later(double horizon);
  void write_stage(CollocationStep& step, int stage,
                   const std::array<Eigen::MatrixXd, collocation_stages + 1>& integrals) const;
  void modal_step(const ModalForm& form, CollocationStep& result) const;
  void dense_step(CollocationStep& result) const;

  FeedbackMatrices matrices_;
  std::optional<ModalForm> form_;  // inputs: u, n, x; outputs: z, y, x; pairs first
  Eigen::Index pairs_ = 0;
  Eigen::MatrixXd to_coordinates_, to_state_, channel_output_, output_;
  Eigen::MatrixXd later_output_;  // v to z at the two times later
};

}  // namespace boresight::plant
