#pragma once

#include <map>
#include <optional>

#include <Eigen/Core>

namespace boresight::control {

/// f(t) = C exp(A t) x of a stable, observable A, t >= 0, searched without a time grid. Each answer
/// follows from bounds on whole intervals, which are halved until the bounds decide. For the
/// observability Gramian W, C W^-1 C' = -2 trace(A) (the trace of A W^-1 + W^-1 A' + W^-1 C'C W^-1
/// = 0). Therefore |f(s)| <= sqrt(-2 trace(A)) |x(t)|_W for all s >= t, and likewise with A^k x for
/// the k-th derivative. No fast pole is skipped and no slow one is cut off, whatever the
/// eigenvectors. If the modes are known, the sum of their magnitudes is a second bound, and the
/// smaller one is used. exp(A h) is formed once for each length h = 2^k of an interval.
/// @throws NumericalFailure from a search that would take more than about 10 s.
class DecayingResponse {
 public:
  /// A: n x n, n >= 1; C: 1 x n, not 0. @throws NumericalFailure if A is not stable.
  DecayingResponse(const Eigen::MatrixXd& a, const Eigen::RowVectorXd& c);
  /// The same for a sum of modes, f(t) = sum of Re(amplitude exp(pole t)): real poles with real
  /// amplitudes, and the pole with Im > 0 of each pair. Keeps the digits of modes of any ratio of
  /// time constants. Starts from `modal_start`.
  DecayingResponse(const Eigen::VectorXcd& poles, const Eigen::VectorXcd& amplitudes);
  const Eigen::VectorXd& modal_start() const { return modal_start_; }

  /// A time with its state.
  struct Point {
    double time = 0.0;
    Eigen::VectorXd state;
    double value = 0.0;
  };
  Point start(const Eigen::VectorXd& state) const;

  /// The first time from `from` on at which f >= level; nothing if there is none before f stays
  /// within `negligible`.
  std::optional<Point> first_reach(const Point& from, double level, double negligible);
  /// The last time from `from` on at which |f| >= level > 0; nothing if there is none.
  std::optional<double> last_beyond(const Point& from, double level);
  /// The earliest maximum of sign f from `from` on, until f stays within `negligible`; sign is 1 or
  /// -1.
  Point extreme(const Point& from, double sign, double negligible);

 private:
  struct Node;
  Node node(double time, Eigen::VectorXd state);
  Node middle(const Node& left, int exponent);
  int horizon(const Point& from, double negligible);
  Node end_of(const Node& left, int exponent);
  bool short_enough(const Node& right, double length) const;

  std::optional<Point> reach_within(const Node& left, const Node& right, int exponent,
                                    double level);
  std::optional<double> beyond_within(const Node& left, const Node& right, int exponent,
                                      double level);
  void extreme_within(const Node& left, const Node& right, int exponent, double sign, Node& best);
  const Eigen::MatrixXd& transition(int exponent);

  Eigen::MatrixXd a_;
  Eigen::VectorXcd poles_;  // of the blocks on the diagonal of A; none if A is not made of modes
  Eigen::MatrixXd amplitudes_;  // a row a mode: |amplitude| |pole|^k for k = 0, 2, 3
  Eigen::VectorXd modal_start_;
  Eigen::MatrixXd derivatives_;  // rows C, C A, C A^2
  Eigen::MatrixXd weights_;      // factors of W for x, A^2 x and A^3 x, times sqrt(-2 trace(A))
  double fastest_ = 0.0;         // 1/s
  double nodes_ = 0.0;           // evaluated so far
  std::map<int, Eigen::MatrixXd> transitions_;  // exp(A 2^exponent)
};

}  // namespace boresight::control
