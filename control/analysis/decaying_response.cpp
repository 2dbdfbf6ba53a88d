#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/analysis/decaying_response.hpp>
#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>

namespace boresight::control {

struct DecayingResponse::Node {
  double time = 0.0;
  Eigen::VectorXd state;
  double value = 0.0, slope = 0.0, curvature = 0.0;  // f, f', f''
  double tail = 0.0;                                 // bound of |f| from here on
  double tail_curvature = 0.0, tail_jerk = 0.0;      // of |f''| and |f'''|
};

namespace {

// Real blocks on the diagonal: 1 x 1, or 2 x 2 of the form [re -im; im re].
Eigen::MatrixXd block_diagonal(const Eigen::VectorXcd& values, const Eigen::VectorXcd& poles) {
  const auto pairs = (poles.imag().array() > 0.0).count();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(poles.size() + pairs, poles.size() + pairs);
  for (Eigen::Index i = 0, at = 0; i < poles.size(); ++i) {
    result(at, at) = values[i].real();
    if (poles[i].imag() > 0.0) {
      result(at + 1, at + 1) = values[i].real();
      result(at + 1, at) = values[i].imag();
      result(at, at + 1) = -values[i].imag();
      ++at;
    }
    ++at;
  }
  return result;
}

// States [Re z; Im z] of each mode, at z = 1.
Eigen::VectorXd modal_states(const Eigen::VectorXcd& poles) {
  const auto pairs = (poles.imag().array() > 0.0).count();
  Eigen::VectorXd result = Eigen::VectorXd::Zero(poles.size() + pairs);
  for (Eigen::Index i = 0, at = 0; i < poles.size(); ++i) {
    result[at] = 1.0;
    at += poles[i].imag() > 0.0 ? 2 : 1;
  }
  return result;
}

// The sum of Re(amplitude z): the rows of the amplitudes' blocks that belong to Re z.
Eigen::RowVectorXd modal_output(const Eigen::VectorXcd& poles, const Eigen::VectorXcd& amplitudes) {
  return modal_states(poles).transpose() * block_diagonal(amplitudes, poles);
}

}  // namespace

DecayingResponse::DecayingResponse(const Eigen::MatrixXd& a, const Eigen::RowVectorXd& c)
    : a_(a), derivatives_(3, a.cols()), weights_(3 * a.rows(), a.cols()), fastest_(a.norm()) {
  const Eigen::Index n = a.rows();
  const Eigen::MatrixXd factor = real_lyapunov_factor(lyapunov_factor(
      "step_characteristics", a.transpose(), c.transpose(), TimeDomain::continuous));
  const Eigen::MatrixXd root = std::sqrt(-2.0 * a.trace()) * factor.transpose();
  derivatives_.row(0) = c;
  derivatives_.row(1) = c * a;
  derivatives_.row(2) = derivatives_.row(1) * a;
  const Eigen::MatrixXd square = a * a;
  weights_.topRows(n) = root;
  weights_.middleRows(n, n) = root * square;
  weights_.bottomRows(n) = root * square * a;
}

DecayingResponse::DecayingResponse(const Eigen::VectorXcd& poles,
                                   const Eigen::VectorXcd& amplitudes)
    : DecayingResponse(block_diagonal(poles, poles), modal_output(poles, amplitudes)) {
  poles_ = poles;
  modal_start_ = modal_states(poles);
  const Eigen::ArrayXd size = poles.cwiseAbs();
  amplitudes_.resize(poles.size(), 3);
  amplitudes_.col(0) = amplitudes.cwiseAbs();
  amplitudes_.col(1) = amplitudes_.col(0).array() * size.square();
  amplitudes_.col(2) = amplitudes_.col(1).array() * size;
}

DecayingResponse::Point DecayingResponse::start(const Eigen::VectorXd& state) const {
  return {0.0, state, derivatives_.row(0).dot(state)};
}

DecayingResponse::Node DecayingResponse::node(double time, Eigen::VectorXd state) {
  const Eigen::Index n = a_.rows();
  constexpr double max_work = 1e10;  // multiplications
  if (++nodes_ * static_cast<double>(n * n) > max_work) {
    throw NumericalFailure(
        "step_characteristics: time constants and frequencies are too many decades apart to follow "
        "the response; leave out what is too fast or too slow to matter");
  }
  const Eigen::Vector3d f = derivatives_ * state;
  const Eigen::VectorXd weighted = weights_ * state;
  Eigen::Vector3d bounds(weighted.head(n).norm(), weighted.segment(n, n).norm(),
                         weighted.tail(n).norm());
  if (poles_.size() > 0) {
    Eigen::Vector3d by_modes = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0, at = 0; i < poles_.size(); ++i) {
      const bool pair = poles_[i].imag() > 0.0;
      const double size = pair ? std::hypot(state[at], state[at + 1]) : std::abs(state[at]);
      by_modes += size * amplitudes_.row(i).transpose();
      at += pair ? 2 : 1;
    }
    bounds = bounds.cwiseMin(by_modes);
  }
  return {time, std::move(state), f[0], f[1], f[2], bounds[0], bounds[1], bounds[2]};
}

const Eigen::MatrixXd& DecayingResponse::transition(int exponent) {
  const auto found = transitions_.find(exponent);
  if (found != transitions_.end()) return found->second;
  const double length = std::ldexp(1.0, exponent);
  Eigen::MatrixXd result;
  if (poles_.size() > 0) {
    result = block_diagonal((length * poles_).array().exp(), poles_);
  } else {
    result = numerics::matrix_exponential(length * a_);
  }
  return transitions_.emplace(exponent, std::move(result)).first->second;
}

DecayingResponse::Node DecayingResponse::end_of(const Node& left, int exponent) {
  return node(left.time + std::ldexp(1.0, exponent), transition(exponent) * left.state);
}

DecayingResponse::Node DecayingResponse::middle(const Node& left, int exponent) {
  return end_of(left, exponent - 1);
}

// The exponent of a time after which f stays within `negligible`.
int DecayingResponse::horizon(const Point& from, double negligible) {
  int exponent = -static_cast<int>(std::floor(std::log2(fastest_)));
  // Beyond the range of time constants that a stable A of this precision can have.
  const int last = exponent + 80;
  while (node(from.time, transition(exponent) * from.state).tail > negligible) {
    if (++exponent > last) {
      throw NumericalFailure(
          fmt::format("step_characteristics: the response has not settled after {:.3g} s, {:.0e} "
                      "times its shortest time constant",
                      std::ldexp(1.0, last), std::ldexp(1.0, 80)));
    }
  }
  return exponent;
}

bool DecayingResponse::short_enough(const Node& right, double length) const {
  return length <= 1e-13 * std::max(right.time, 1.0 / fastest_);
}

std::optional<DecayingResponse::Point> DecayingResponse::first_reach(const Point& from,
                                                                     double level,
                                                                     double negligible) {
  const Node left = node(from.time, from.state);
  const int exponent = horizon(from, negligible);
  return reach_within(left, end_of(left, exponent), exponent, level);
}

std::optional<DecayingResponse::Point> DecayingResponse::reach_within(const Node& left,
                                                                      const Node& right,
                                                                      int exponent, double level) {
  if (left.value >= level) return Point{left.time, left.state, left.value};
  const double length = std::ldexp(1.0, exponent);
  const double highest =
      std::max(left.value, right.value) + 0.125 * left.tail_curvature * length * length;
  const bool monotone = std::abs(left.slope) > left.tail_curvature * length;
  if (highest < level || (monotone && right.value < level)) return std::nullopt;
  if (short_enough(right, length)) {
    if (right.value < level) return std::nullopt;
    return Point{right.time, right.state, right.value};
  }
  const Node half = middle(left, exponent);
  auto found = reach_within(left, half, exponent - 1, level);
  return found ? found : reach_within(half, right, exponent - 1, level);
}

std::optional<double> DecayingResponse::last_beyond(const Point& from, double level) {
  const Node left = node(from.time, from.state);
  const int exponent = horizon(from, 0.5 * level);
  return beyond_within(left, end_of(left, exponent), exponent, level);
}

std::optional<double> DecayingResponse::beyond_within(const Node& left, const Node& right,
                                                      int exponent, double level) {
  // Later times have been searched already.
  if (std::abs(right.value) >= level) return right.time;
  const double length = std::ldexp(1.0, exponent);
  const double farthest = std::max(std::abs(left.value), std::abs(right.value)) +
                          0.125 * left.tail_curvature * length * length;
  if (std::min(farthest, left.tail) < level) return std::nullopt;
  const bool monotone = std::abs(left.slope) > left.tail_curvature * length;
  if (monotone && std::abs(left.value) < level) return std::nullopt;
  if (short_enough(right, length)) {
    if (std::abs(left.value) < level) return std::nullopt;
    return left.time;
  }
  const Node half = middle(left, exponent);
  const auto found = beyond_within(half, right, exponent - 1, level);
  return found ? found : beyond_within(left, half, exponent - 1, level);
}

DecayingResponse::Point DecayingResponse::extreme(const Point& from, double sign,
                                                  double negligible) {
  const Node left = node(from.time, from.state);
  const int exponent = horizon(from, negligible);
  Node best = left;
  extreme_within(left, end_of(left, exponent), exponent, sign, best);
  // Rounding may lift a response that only leaves its start slowly above it.
  if (sign * (best.value - left.value) <= 1e-13 * std::abs(left.value)) return from;
  return {best.time, best.state, best.value};
}

void DecayingResponse::extreme_within(const Node& left, const Node& right, int exponent,
                                      double sign, Node& best) {
  const auto consider = [&](const Node& candidate) {
    const double gain = sign * (candidate.value - best.value);
    if (gain > 0.0 || (gain == 0.0 && candidate.time < best.time)) best = candidate;
  };
  consider(right);
  const double length = std::ldexp(1.0, exponent);
  const double highest = std::max(sign * left.value, sign * right.value) +
                         0.125 * left.tail_curvature * length * length;
  if (highest <= sign * best.value || std::abs(left.slope) > left.tail_curvature * length ||
      short_enough(right, length)) {
    return;
  }
  if (std::abs(left.curvature) > left.tail_jerk * length) {
    // Bent one way throughout: an extreme within only where the slope turns downwards.
    if (sign * left.slope <= 0.0 || sign * right.slope >= 0.0) return;
    Node before = left, after = right;
    for (int e = exponent; !short_enough(after, std::ldexp(1.0, e)); --e) {
      Node half = middle(before, e);
      (sign * half.slope > 0.0 ? before : after) = std::move(half);
    }
    consider(after);
    return;
  }
  const Node half = middle(left, exponent);
  extreme_within(left, half, exponent - 1, sign, best);
  extreme_within(half, right, exponent - 1, sign, best);
}

}  // namespace boresight::control
