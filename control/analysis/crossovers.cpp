#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/crossovers_on_grid.hpp>
#include <boresight/control/analysis/loop_response.hpp>
#include <boresight/control/analysis/transmission_zeros.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// The loop closed by the gain f, L/(1 + f L). @throws NumericalFailure if it has no solution.
plant::StateSpace with_feedback(const plant::StateSpace& loop, double f) {
  const double inverse = 1.0 / (1.0 + f * loop.d(0, 0));
  if (!(std::abs(inverse) < 1e6)) throw NumericalFailure("crossovers: no solution at infinity");
  plant::StateSpace result = loop;
  result.a -= f * inverse * loop.b * loop.c;
  result.b *= inverse;
  result.c *= inverse;
  result.d *= inverse;
  return result;
}

// @throws NumericalFailure if the matrix is singular.
Eigen::MatrixXd solved(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  Eigen::MatrixXd result = numerics::linear_solve(matrix, right, "crossovers");
  // The condition estimate of an exactly singular matrix can be finite.
  if (!result.allFinite()) throw NumericalFailure("crossovers: the matrix is singular");
  return result;
}

// A sampled loop as a function of v = (z - 1)/(z + 1), which takes the unit circle to the imaginary
// axis: v = j tan(w T/2). @throws NumericalFailure for a pole at z = -1.
plant::StateSpace bilinear(const plant::StateSpace& loop) {
  const Eigen::Index n = loop.a.rows();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd right(n, n + 1);
  right << loop.a - identity, loop.b;
  const Eigen::MatrixXd quotient = solved(loop.a + identity, right);
  plant::StateSpace result = loop;
  result.a = quotient.leftCols(n);
  result.b = quotient.rightCols(1);
  result.c = loop.c * (identity - result.a);
  result.d = loop.d - loop.c * result.b;
  result.sample_time = 0.0;
  return result;
}

// L(1/s). @throws NumericalFailure for a pole at 0.
plant::StateSpace reversed(const plant::StateSpace& loop) {
  const Eigen::Index n = loop.a.rows();
  Eigen::MatrixXd right(n, n + 1);
  right << Eigen::MatrixXd::Identity(n, n), loop.b;
  const Eigen::MatrixXd quotient = solved(loop.a, right);
  plant::StateSpace result = loop;
  result.a = quotient.leftCols(n);
  result.b = quotient.rightCols(1);
  result.c = -loop.c * result.a;
  result.d = loop.d - loop.c * result.b;
  return result;
}

// M = L/(1 + f L), of a continuous loop or mapped to continuous time.
struct FedBackLoop {
  plant::StateSpace system;
  double f = 0.0;
};

// What the features of a loop say of its scales.
struct Scales {
  double slowest = 0.0;  // rad/s, of what is not an integrator; 0 without features
  // Feedback gains that move poles: none, and some of the order of 1/|L| at middle and at slow
  // frequencies.
  std::vector<double> feedback{0.0};
};

Scales scales_of(LoopResponse& response) {
  double fastest = 0.0;
  for (const auto feature : response.continuous_features()) {
    if (std::isfinite(std::abs(feature))) fastest = std::max(fastest, std::abs(feature));
  }
  Scales scales;
  if (fastest == 0.0) return scales;
  scales.slowest = fastest;
  for (const auto feature : response.continuous_features()) {
    const double magnitude = std::abs(feature);
    if (magnitude > 1e-12 * fastest) scales.slowest = std::min(scales.slowest, magnitude);
  }
  for (const double w : {std::sqrt(scales.slowest * fastest), scales.slowest}) {
    const double magnitude = std::abs(response.at(std::min(w, 0.9 * response.nyquist_frequency())));
    if (magnitude == 0.0 || !std::isfinite(magnitude)) continue;
    scales.feedback.push_back(0.37 / magnitude);
    scales.feedback.push_back(-0.41 / magnitude);
  }
  return scales;
}

// `map` of the loop, closed by more feedback where that moves away poles that it sends to infinity,
// or beyond `furthest`; without a value if none does.
std::optional<FedBackLoop> mapped(const FedBackLoop& loop, const std::vector<double>& feedback,
                                  plant::StateSpace (*map)(const plant::StateSpace&),
                                  double furthest) {
  for (const double more : feedback) {
    try {
      FedBackLoop result{map(plant::balanced(with_feedback(loop.system, more))), loop.f + more};
      const Eigen::MatrixXd& a = result.system.a;
      if (a.size() == 0 || a.cwiseAbs().maxCoeff() <= furthest) return result;
    } catch (const NumericalFailure&) {
      continue;
    }
  }
  return std::nullopt;
}

// M(s) = L/(1 + f L) and its mirror image M(-s), with the response of
//   gain: (1 - f M(s)) (1 - f M(-s)) - M(s) M(-s), zero where |L| = 1;
//   phase: M(s) - M(-s), zero where L is real.
plant::StateSpace with_mirror_image(const FedBackLoop& loop, CrossoverKind kind) {
  const auto& [a, b, c, d, inputs, outputs, states, sample_time] = loop.system;
  const Eigen::Index n = a.rows();
  const double direct = d(0, 0), f = loop.f;
  // The mirror image, x' = -A' x' - C' v, w = B' x' + D v, is driven by v = drive y + own u, and
  // u + from_output y + w (gain) or y - w (phase) goes out.
  const bool gain = kind == CrossoverKind::gain;
  const double drive = gain ? f * f - 1.0 : 0.0, own = gain ? -f : -1.0;
  const double from_output = gain ? -f : 1.0, from_input = gain ? 1.0 : 0.0;
  plant::StateSpace result;
  result.a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  result.a.topLeftCorner(n, n) = a;
  result.a.bottomLeftCorner(n, n) = -drive * c.transpose() * c;
  result.a.bottomRightCorner(n, n) = -a.transpose();
  result.b.resize(2 * n, 1);
  result.b << b, -(drive * direct + own) * c.transpose();
  result.c.resize(1, 2 * n);
  result.c << (from_output + drive * direct) * c, b.transpose();
  result.d = Eigen::MatrixXd::Constant(
      1, 1, from_input + from_output * direct + direct * (drive * direct + own));
  result.inputs = inputs;
  result.outputs = outputs;
  for (Eigen::Index i = 1; i <= 2 * n; ++i) result.states.push_back(fmt::format("x{}", i));
  return result;
}

// Zeros near the imaginary axis, of gain and of phase crossovers.
using Candidates = std::array<std::vector<Complex>, 2>;

// Those of the loop; of L(1/s) those of 1/s.
void add_candidates(const FedBackLoop& loop, bool is_reversed, Candidates& candidates) {
  // Damping ratio below which a zero may stand for a crossover or a tangency.
  constexpr double lightly_damped = 0.5;
  for (const auto kind : {CrossoverKind::gain, CrossoverKind::phase}) {
    for (const Complex s : transmission_zeros(with_mirror_image(loop, kind))) {
      if (!(s.imag() > 0.0) || !(std::abs(s.real()) < lightly_damped * std::abs(s))) continue;
      candidates[kind == CrossoverKind::gain ? 0 : 1].push_back(is_reversed ? 1.0 / std::conj(s)
                                                                            : s);
    }
  }
}

// Adds the frequencies at which to look for one kind of crossover: zeros near the boundary, points
// beyond what rounding or near-tangency moved them off it, and points between neighbours.
void add_dividing_points(std::vector<Complex>& candidates, double nyquist,
                         std::vector<double>& points) {
  std::sort(candidates.begin(), candidates.end(),
            [](Complex p, Complex q) { return p.imag() < q.imag(); });
  double last = 0.0, last_off = 0.0;
  for (const Complex s : candidates) {
    const double w = s.imag(), off = std::abs(s.real());
    // One zero found twice, or mirror images.
    if (w - last < std::max(std::min(off, last_off), 1e-10 * w)) continue;
    points.push_back(last > 0.0 ? std::sqrt(last * w) : w / 3.0);
    points.push_back(w);
    const double around = std::max(3.0 * off, 1e-4 * w);
    points.push_back(w + around);
    if (around < w) points.push_back(w - around);
    last = w;
    last_off = off;
  }
  if (last > 0.0) points.push_back(std::isfinite(nyquist) ? 0.5 * (last + nyquist) : 3.0 * last);
}

Eigen::ArrayXd dividing_grid(Candidates candidates, double nyquist) {
  std::vector<double> points;
  for (auto& of_kind : candidates) add_dividing_points(of_kind, nyquist, points);
  std::sort(points.begin(), points.end());
  std::vector<double> rising;
  for (const double w : points) {
    if (w < nyquist && (rising.empty() || w > rising.back())) rising.push_back(w);
  }
  return Eigen::Map<Eigen::ArrayXd>(rising.data(), static_cast<Eigen::Index>(rising.size()));
}

}  // namespace

Crossovers crossovers(const plant::StateSpace& loop, const CrossoverOptions& options) {
  LoopResponse response("crossovers", loop);
  const double time = loop.sample_time;
  const Scales scales = scales_of(response);
  Candidates candidates;
  // How far poles may go, beside the loop's own scale, for the rest to keep its digits.
  constexpr double far_sampled = 1e6, far_reversed = 1e9;
  const std::optional<FedBackLoop> direct =
      time > 0.0 ? mapped({loop, 0.0}, scales.feedback, bilinear, far_sampled)
                 : FedBackLoop{loop, 0.0};
  if (!direct) {
    throw NumericalFailure(
        "crossovers: A has an eigenvalue of -1 that no feedback moves, out of reach of input or "
        "output; take plant::minimal_realisation first");
  }
  add_candidates(*direct, false, candidates);
  // Rounding spoils the smallest of zeros that are many decades apart: those of L(1/s) besides.
  const double slowest = time > 0.0 ? 0.5 * time * scales.slowest : scales.slowest;
  const auto inverse = mapped(*direct, scales.feedback, reversed, far_reversed / slowest);
  if (inverse) add_candidates(*inverse, true, candidates);
  if (time > 0.0) {
    for (auto& of_kind : candidates) {
      for (Complex& s : of_kind) {
        const double w = 2.0 * std::atan(s.imag()) / time;
        s = {s.real() / s.imag() * w, w};
      }
    }
  }
  Crossovers result = crossovers_on_grid(
      response.on_grid(dividing_grid(std::move(candidates), response.nyquist_frequency())),
      options);
  response.add_real_ends(result.phase);
  return result;
}

}  // namespace boresight::control
