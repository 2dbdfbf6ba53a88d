#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// The response C (s I - A)^-1 B + D of a dense state space, prepared once in O(n^3) for each input
/// and then O(n^2) a frequency and input. For a sampled system z stands for s.
///
/// The states are balanced and then transformed, for each input b, so that A is upper Hessenberg
/// and b a multiple of the first unit vector (what that input cannot reach is dropped), by
/// elementary transformations with pivoting: they keep the digits of slow states beside fast ones,
/// which orthogonal ones mix (J. H. Wilkinson, The Algebraic Eigenvalue Problem, 1965, ch. 6). All
/// rows of (s I - H) x = b but the first then give x from the last element upwards up to a factor,
/// which the first row settles: a substitution without elimination, fill-in or pivoting, stable row
/// by row (Hyman's method, ibid., ch. 7; for frequency responses P. Misra, R. V. Patel, IEEE Trans.
/// Automatic Control 33, 1988). A sampled system is taken in z - 1, so that slow poles next to
/// z = 1 keep their digits.
///
/// The transposed system, from the outputs, has the same response with other rounding errors: where
/// slow states feed fast ones or the reverse, one of the two keeps several digits more. Both are
/// tried, and where they differ the one nearer to a linear solve is kept.
///
/// Errors are some 1e-16 of the norm of the balanced A, less where A is graded. Keeps its work
/// arrays: one object a thread.
class DenseResponse {
 public:
  enum class Start { better, inputs, outputs };

  /// `start`: reduce from the inputs, from the outputs, or the better of the two.
  /// @throws InvalidInput as validate(system).
  explicit DenseResponse(const StateSpace& system, Start start = Start::better);

  Eigen::Index order() const { return order_; }
  Eigen::Index inputs() const { return feedthrough_.cols(); }
  Eigen::Index outputs() const { return feedthrough_.rows(); }
  double sample_time() const { return sample_time_; }
  /// Where the reduction starts: inputs or outputs.
  Start start() const { return start_; }

  /// All channels, outputs x inputs, at any complex s (or z); allocates nothing if `response` has
  /// that shape. False if s is a pole to working precision: the columns of the inputs, or rows of
  /// the outputs, that reach the pole are infinite then.
  /// @throws InvalidInput if s is not finite.
  [[nodiscard]] bool evaluate(std::complex<double> s, Eigen::MatrixXcd& response);

  /// The same. @throws NumericalFailure where s is a pole.
  Eigen::MatrixXcd at(std::complex<double> s);

  /// One channel at one angular frequency (rad/s; s = j w or z = e^(j w T)); infinite at a pole.
  /// @throws InvalidInput for a frequency that is not finite, an input or output that the system
  /// has not.
  std::complex<double> channel(double angular_frequency, Eigen::Index output = 0,
                               Eigen::Index input = 0);

  /// One channel at many angular frequencies, the same bits as one by one but several times
  /// faster; allocates nothing if `response` has their size. Infinite at a pole.
  /// @throws InvalidInput as channel.
  void evaluate(const Eigen::ArrayXd& angular_frequency, Eigen::ArrayXcd& response,
                Eigen::Index output = 0, Eigen::Index input = 0);

 private:
  friend struct HymanSubstitution;

  // What one input reaches (of the transposed system: one output). `elements` holds H row by row
  // from the last to the second, each from the right to the diagonal, then the inverse of the
  // element left of it; last the first row.
  struct Reach {
    Eigen::Index order = 0;
    double entry = 0.0;  // the first element of b
    std::vector<double> elements;
    Eigen::MatrixXd output;  // order x outputs
  };

  static std::vector<Reach> reaches(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                    const Eigen::MatrixXd& c);
  void choose_start(const StateSpace& scaled);
  bool evaluate_shifted(std::complex<double> s, Eigen::MatrixXcd& response);
  std::complex<double> point(double angular_frequency) const;
  const Reach& reach_of(Eigen::Index output, Eigen::Index input) const;

  Eigen::Index order_ = 0;
  double sample_time_ = 0.0;
  Eigen::MatrixXd feedthrough_;
  Start start_ = Start::inputs;
  std::vector<Reach> reach_;
  std::vector<double> work_;
};

}  // namespace boresight::plant
