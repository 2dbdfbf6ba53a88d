#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>

namespace boresight::identification {
namespace {

using C = MechanicalCoefficients;
using Eigen::Index;

constexpr double infinity = std::numeric_limits<double>::infinity();

// e^-x, without the slow ways of a library where nothing is left.
double decay(double x) {
  return x < 40.0 ? std::exp(-x) : 0.0;
}

// Friction without its viscous part at a rate >= 0 (plant::dry_friction), and its derivatives.
struct DryFriction {
  double u, x, bump, rise, value, by_rate;
  DryFriction(const Eigen::VectorXd& c, double rate)
      : u(rate / c(C::stribeck_rate)),
        x(rate / c(C::saturating_rate)),
        bump(decay(u * u)),
        rise(decay(x)),
        value(c(C::coulomb_torque) + c(C::stribeck_torque) * bump +
              c(C::saturating_torque) * (1.0 - rise)),
        by_rate(-2.0 * u * bump * c(C::stribeck_torque) / c(C::stribeck_rate) +
                rise * c(C::saturating_torque) / c(C::saturating_rate)) {}
  // By coulomb_torque .. saturating_rate.
  Eigen::Matrix<double, 5, 1> by(const Eigen::VectorXd& c) const {
    Eigen::Matrix<double, 5, 1> out;
    out << 1.0, bump, c(C::stribeck_torque) * bump * 2.0 * u * u / c(C::stribeck_rate), 1.0 - rise,
        -c(C::saturating_torque) * rise * x / c(C::saturating_rate);
    return out;
  }
};

// e^-r, (1 - e^-r)/r and (1 - that)/r with the derivatives of the latter two.
struct Relaxation {
  double decay, mean, mean_by, second, second_by;
  explicit Relaxation(double r) : decay(boresight::identification::decay(r)) {
    if (r < 0.03) {
      mean = 1.0 + r * (-1.0 / 2 + r * (1.0 / 6 + r * (-1.0 / 24 + r / 120)));
      mean_by = -1.0 / 2 + r * (1.0 / 3 + r * (-1.0 / 8 + r * (1.0 / 30 - r / 144)));
      second = 1.0 / 2 + r * (-1.0 / 6 + r * (1.0 / 24 + r * (-1.0 / 120 + r / 720)));
      second_by = -1.0 / 6 + r * (1.0 / 12 + r * (-1.0 / 40 + r * (1.0 / 180 - r / 1008)));
    } else {
      mean = (1.0 - decay) / r;
      mean_by = (decay - mean) / r;
      second = (1.0 - mean) / r;
      second_by = (-mean_by - second) / r;
    }
  }
};

}  // namespace

MechanicalStepper::MechanicalStepper(Eigen::VectorXd coefficients, double sample_time,
                                     bool derivatives)
    : c_(std::move(coefficients)), h_(sample_time), derivatives_(derivatives) {
  const Index mode_count = (c_.size() - C::modes) / 2;
  if (c_.size() < C::modes || c_.size() != C::count(mode_count)) {
    throw InvalidInput(
        fmt::format("MechanicalStepper: expected {} coefficients and 2 for each mode, found {}",
                    Index{C::modes}, c_.size()));
  }
  effective_inertia_ = c_(C::rigid_inertia);
  const double zeta = c_(C::mode_damping);
  for (Index i = 0; i < mode_count; ++i) {
    Mode mode;
    mode.inertia = c_(C::inertia(i));
    const double w = c_(C::frequency(i));
    // The states, then their derivatives by frequency and by damping.
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(6, 6);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(6, 1);
    for (Index k = 0; k < 6; k += 2) {
      a.block<2, 2>(k, k) << 0.0, 1.0, -w * w, -2.0 * zeta * w;
    }
    a.block<1, 2>(3, 0) << -2.0 * w, -2.0 * zeta;
    a.block<1, 2>(5, 0) << 0.0, -2.0 * w;
    b.col(0) << -1.0, 2.0 * zeta * w, 0.0, 2.0 * zeta, 0.0, 2.0 * w;
    const auto t = numerics::held_transition(a, b, h_);
    const Eigen::MatrixXd start = t.step - t.ramp;
    mode.step << t.state.block<2, 2>(0, 0), start.topRows(2), t.ramp.topRows(2);
    mode.by_frequency << t.state.block<2, 2>(2, 0), start.middleRows(2, 2), t.ramp.middleRows(2, 2);
    mode.by_damping << t.state.block<2, 2>(4, 0), start.bottomRows(2), t.ramp.bottomRows(2);
    effective_inertia_ += mode.inertia * mode.step(1, 3);
    modes_.push_back(mode);
  }
  const double q = h_ / c_(C::tachometer_lag);
  const Relaxation lag(q);
  const double q_by = -q / c_(C::tachometer_lag);
  lag_decay_ = lag.decay;
  lag_start_ = lag.mean - lag.decay;
  lag_end_ = 1.0 - lag.mean;
  lag_decay_by_ = -lag.decay * q_by;
  lag_start_by_ = (lag.mean_by + lag.decay) * q_by;
  lag_end_by_ = -lag.mean_by * q_by;
  x_.resize(modes_.size());
  if (derivatives_) {
    by_.setZero(c_.size(), 3 + 2 * mode_count);
    mean_by_.setZero(c_.size());
    end_rate_by_.setZero(c_.size());
    s_by_.setZero(c_.size());
    scratch_.setZero(c_.size());
  }
}

void MechanicalStepper::restart(double rate, double torque) {
  v_ = tach_ = rate;
  last_change_ = 0.0;
  for (auto& x : x_) x << 0.0, rate;
  // Bristles bend with the motion, or at rest hold the torque as far as they can.
  const double stiffness = c_(C::bristle_stiffness);
  const double speed = std::abs(rate);
  const bool moving = speed > 0.1 * c_(C::stribeck_rate);
  const DryFriction maximum(c_, speed);
  const double held = torque - c_(C::offset_torque);
  const bool slipping = moving || std::abs(held) > maximum.value;
  const double sign = std::copysign(1.0, moving ? rate : held);
  z_ = (slipping ? sign * maximum.value : held) / stiffness;
  if (!derivatives_) return;
  by_.setZero();
  if (slipping) {
    by_.col(1).segment<5>(C::coulomb_torque) = sign / stiffness * maximum.by(c_);
  } else {
    by_(C::offset_torque, 1) = -1.0 / stiffness;
  }
  by_(C::bristle_stiffness, 1) = -z_ / stiffness;
  // The rate is what the recorder shows less its zero.
  by_(C::tachometer_zero, 0) = by_(C::tachometer_zero, 2) = -1.0;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    by_(C::tachometer_zero, 4 + 2 * static_cast<Index>(i)) = -1.0;
  }
  if (slipping) {
    by_(C::tachometer_zero, 1) -= sign * std::copysign(1.0, rate) * maximum.by_rate / stiffness;
  }
}

// Over a step at a constant rate u: r = sigma0 |u| h/g, z goes to z e^-r + u h (1 - e^-r)/r, its
// mean is z (1 - e^-r)/r + u h (1 - (1 - e^-r)/r)/r.
void MechanicalStepper::bristle(double u, bool derivatives, Bristle& out) const {
  const double stiffness = c_(C::bristle_stiffness);
  const double damping = c_(C::bristle_damping);
  const double speed = std::abs(u);
  const DryFriction g(c_, speed);
  const double r = stiffness * h_ * speed / g.value;
  const Relaxation e(r);
  const double mean = z_ * e.mean + u * h_ * e.second;
  const double mean_by_r = z_ * e.mean_by + u * h_ * e.second_by;
  const double end_by_r = -z_ * e.decay + u * h_ * e.mean_by;
  const double r_by_rate =
      std::copysign(stiffness * h_ * (g.value - speed * g.by_rate) / (g.value * g.value), u);
  out.end = z_ * e.decay + u * h_ * e.mean;
  out.mean_torque = stiffness * mean + damping * (out.end - z_) / h_ + c_(C::viscous_friction) * u;
  out.end_by_rate = h_ * e.mean + end_by_r * r_by_rate;
  const double torque_by_r = stiffness * mean_by_r + damping / h_ * end_by_r;
  out.torque_by_rate = stiffness * h_ * e.second + damping * e.mean + torque_by_r * r_by_rate +
                       c_(C::viscous_friction);
  if (!derivatives) return;
  out.end_by_z = e.decay;
  out.torque_by_z = stiffness * e.mean + damping * (e.decay - 1.0) / h_;
  const Eigen::Matrix<double, 5, 1> g_by = g.by(c_);
  out.torque_by.head<5>() = -torque_by_r * r / g.value * g_by;
  out.end_by.head<5>() = -end_by_r * r / g.value * g_by;
  out.torque_by.tail<3>() << u, mean + torque_by_r * r / stiffness, (out.end - z_) / h_;
  out.end_by.tail<3>() << 0.0, end_by_r * r / stiffness, 0.0;
}

// Mean rate u with 2 effective inertia u + h friction(u) = push: Newton between bounds that close
// in; the left side rises wherever friction's fall with rate is not steeper than the inertia's
// rise.
bool MechanicalStepper::solve(double push, double& mean_rate, Bristle& b) const {
  double low = -infinity, high = infinity;
  for (int k = 0; k < 60; ++k) {
    bristle(mean_rate, false, b);
    const double excess = 2.0 * effective_inertia_ * mean_rate + h_ * b.mean_torque - push;
    if (!std::isfinite(excess)) return false;
    (excess > 0.0 ? high : low) = mean_rate;
    const double slope = 2.0 * effective_inertia_ + h_ * b.torque_by_rate;
    double next = mean_rate - excess / slope;
    // What a step of Newton's leaves is its square.
    if (std::abs(next - mean_rate) <= 1e-10 * (std::abs(next) + std::abs(v_)) + 1e-13) {
      mean_rate = next;
      return true;
    }
    if (next <= low || next >= high) {
      next = std::isinf(low) || std::isinf(high) ? mean_rate - 2.0 * excess / effective_inertia_
                                                 : 0.5 * (low + high);
    }
    mean_rate = next;
  }
  return true;
}

bool MechanicalStepper::step(double torque, double common, double error,
                             const Eigen::VectorXd& error_by) {
  // What multiplies the end rate 2u - v, and everything else of the momentum balance.
  double push = h_ * (torque - c_(C::offset_torque) - c_(C::common_torque) * common +
                      c_(C::correction) * error) +
                (c_(C::rigid_inertia) + effective_inertia_) * v_;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto& m = modes_[i].step;
    push -= modes_[i].inertia * (m(1, 0) * x_[i](0) + (m(1, 1) - 1.0) * x_[i](1) + m(1, 2) * v_);
  }
  double mean_rate = v_ + 0.5 * last_change_;
  Bristle b;
  if (!solve(push, mean_rate, b)) return false;
  bristle(mean_rate, derivatives_, b);
  if (derivatives_) differentiate(mean_rate, common, error, error_by, b);
  const double end_rate = 2.0 * mean_rate - v_;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const Eigen::Vector4d from{x_[i](0), x_[i](1), v_, end_rate};
    x_[i] = modes_[i].step * from;
  }
  tach_ = lag_decay_ * tach_ + lag_start_ * v_ + lag_end_ * end_rate;
  z_ = b.end;
  last_change_ = end_rate - v_;
  v_ = end_rate;
  return true;
}

void MechanicalStepper::differentiate(double mean_rate, double common, double error,
                                      const Eigen::VectorXd& error_by, const Bristle& b) {
  const double end_rate = 2.0 * mean_rate - v_;
  // Derivatives of 2 Je u + h friction - push = 0 with u held.
  auto& balance = scratch_;
  balance = h_ * b.torque_by_z * by_.col(1) -
            (c_(C::rigid_inertia) + effective_inertia_) * by_.col(0) -
            h_ * c_(C::correction) * error_by;
  balance.segment<8>(C::coulomb_torque) += h_ * b.torque_by;
  balance(C::rigid_inertia) += end_rate - v_;
  balance(C::offset_torque) += h_;
  balance(C::common_torque) += h_ * common;
  balance(C::correction) -= h_ * error;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto& mode = modes_[i];
    const auto k = static_cast<Index>(i);
    const Eigen::Vector4d from{x_[i](0), x_[i](1), v_, end_rate};
    balance += mode.inertia *
               (mode.step(1, 0) * by_.col(3 + 2 * k) +
                (mode.step(1, 1) - 1.0) * by_.col(4 + 2 * k) + mode.step(1, 2) * by_.col(0));
    balance(C::inertia(k)) += mode.step.row(1).dot(from) - x_[i](1);
    balance(C::frequency(k)) += mode.inertia * mode.by_frequency.row(1).dot(from);
    balance(C::mode_damping) += mode.inertia * mode.by_damping.row(1).dot(from);
  }
  mean_by_ = balance * (-1.0 / (2.0 * effective_inertia_ + h_ * b.torque_by_rate));
  end_rate_by_ = 2.0 * mean_by_ - by_.col(0);
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto& mode = modes_[i];
    const auto k = static_cast<Index>(i);
    const Eigen::Vector4d from{x_[i](0), x_[i](1), v_, end_rate};
    const Eigen::Vector2d by_frequency = mode.by_frequency * from;
    const Eigen::Vector2d by_damping = mode.by_damping * from;
    s_by_ = mode.step(0, 0) * by_.col(3 + 2 * k) + mode.step(0, 1) * by_.col(4 + 2 * k) +
            mode.step(0, 2) * by_.col(0) + mode.step(0, 3) * end_rate_by_;
    by_.col(4 + 2 * k) = mode.step(1, 0) * by_.col(3 + 2 * k) +
                         mode.step(1, 1) * by_.col(4 + 2 * k) + mode.step(1, 2) * by_.col(0) +
                         mode.step(1, 3) * end_rate_by_;
    by_.col(3 + 2 * k) = s_by_;
    by_(C::frequency(k), 3 + 2 * k) += by_frequency(0);
    by_(C::frequency(k), 4 + 2 * k) += by_frequency(1);
    by_(C::mode_damping, 3 + 2 * k) += by_damping(0);
    by_(C::mode_damping, 4 + 2 * k) += by_damping(1);
  }
  by_.col(2) = lag_decay_ * by_.col(2) + lag_start_ * by_.col(0) + lag_end_ * end_rate_by_;
  by_(C::tachometer_lag, 2) += lag_decay_by_ * tach_ + lag_start_by_ * v_ + lag_end_by_ * end_rate;
  by_.col(1) = b.end_by_z * by_.col(1) + b.end_by_rate * mean_by_;
  by_.col(1).segment<8>(C::coulomb_torque) += b.end_by;
  by_.col(0) = end_rate_by_;
}

void predict_rate(const GreyBoxRecord& record, const Eigen::VectorXd& coefficients,
                  Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
  MechanicalStepper stepper(coefficients, record.sample_time, jacobian != nullptr);
  const Index samples = record.samples();
  residuals.resize(samples);
  if (jacobian != nullptr) jacobian->resize(coefficients.size(), samples);
  const double zero = coefficients(C::tachometer_zero);
  Eigen::VectorXd error_by = Eigen::VectorXd::Zero(coefficients.size());
  for (Index k = 0; k < samples; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (record.rate_restarts[at]) stepper.restart(record.rate(k) - zero, record.torque(k));
    residuals(k) = record.rate(k) - zero - stepper.tachometer();
    if (jacobian != nullptr) {
      error_by = -stepper.tachometer_by();
      error_by(C::tachometer_zero) -= 1.0;
      jacobian->col(k) = error_by;
      if (!record.rate_known[at]) error_by.setZero();
    }
    if (k + 1 == samples) break;
    const double error = record.rate_known[at] ? residuals(k) : 0.0;
    if (!stepper.step(0.5 * (record.torque(k) + record.torque(k + 1)),
                      0.5 * (record.common(k) + record.common(k + 1)), error, error_by)) {
      residuals.tail(samples - k).setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
  }
}

}  // namespace boresight::identification
