#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Core>

#include <boresight/plant/integration/ode_system.hpp>

namespace boresight::reference {

using StateRef = Eigen::Ref<const Eigen::VectorXd>;
using VectorRef = Eigen::Ref<Eigen::VectorXd>;
using MatrixRef = Eigen::Ref<Eigen::MatrixXd>;

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

/// x' = A x + b.
class Linear : public plant::OdeSystem {
 public:
  Linear(Eigen::MatrixXd a, Eigen::VectorXd b) : a_(std::move(a)), b_(std::move(b)) {}
  Eigen::Index states() const override { return b_.size(); }
  void rate(double, const StateRef& x, VectorRef dx) const override {
    dx = b_;
    dx.noalias() += a_ * x;
  }
  void jacobian(double, const StateRef&, MatrixRef j) const override { j = a_; }
  void push(const Eigen::VectorXd& b) { b_ = b; }

 private:
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
};

/// x'' = -w^2 x.
inline Linear oscillator(double w) {
  Eigen::MatrixXd a(2, 2);
  a << 0.0, 1.0, -w * w, 0.0;
  return {a, Eigen::VectorXd::Zero(2)};
}

/// y0' = -k y0, y1' = c (y0 - y1) with the event y0 = level: stiff for c much above k.
class LagOfDecay : public plant::OdeSystem {
 public:
  double k = 1.0, c = 1000.0, level = 0.5;
  Eigen::Index states() const override { return 2; }
  void rate(double, const StateRef& y, VectorRef dy) const override {
    dy(0) = -k * y(0);
    dy(1) = c * (y(0) - y(1));
  }
  void jacobian(double, const StateRef&, MatrixRef j) const override { j << -k, 0.0, c, -c; }
  Eigen::Index events() const override { return 1; }
  void event_values(double, const StateRef& y, VectorRef g) const override { g(0) = y(0) - level; }
  Eigen::Index parameters() const override { return 2; }
  void rate_by_parameters(double, const StateRef& y, MatrixRef df_dp) const override {
    df_dp(0, 0) = -y(0);
    df_dp(1, 1) = y(0) - y(1);
  }
  /// From (1, 0).
  Eigen::VectorXd solution(double t) const {
    const double slow = std::exp(-k * t), fast = std::exp(-c * t);
    return vector({slow, c / (c - k) * (slow - fast)});
  }
  Eigen::MatrixXd sensitivity(double t) const {
    const double slow = std::exp(-k * t), fast = std::exp(-c * t), d = c - k;
    Eigen::MatrixXd s(2, 2);
    s << -t * slow, 0.0, c / (d * d) * (slow - fast) - c / d * t * slow,
        -k / (d * d) * (slow - fast) + c / d * t * fast;
    return s;
  }
};

/// x'' = mu (1 - x^2) x' - x.
class VanDerPol : public plant::OdeSystem {
 public:
  double mu = 5.0;
  Eigen::Index states() const override { return 2; }
  void rate(double, const StateRef& x, VectorRef dx) const override {
    dx(0) = x(1);
    dx(1) = mu * (1.0 - x(0) * x(0)) * x(1) - x(0);
  }
  void jacobian(double, const StateRef& x, MatrixRef j) const override {
    j << 0.0, 1.0, -2.0 * mu * x(0) * x(1) - 1.0, mu * (1.0 - x(0) * x(0));
  }
  Eigen::Index parameters() const override { return 1; }
  void rate_by_parameters(double, const StateRef& x, MatrixRef df_dp) const override {
    df_dp(1, 0) = (1.0 - x(0) * x(0)) * x(1);
  }
};

/// q'' = -w^2 sin q - d q' |q'|; parameters w, d; events at the turning points and at the bottom.
class Pendulum : public plant::OdeSystem {
 public:
  double w = 3.0, d = 0.0;
  Eigen::Index states() const override { return 2; }
  void rate(double, const StateRef& x, VectorRef dx) const override {
    dx(0) = x(1);
    dx(1) = -w * w * std::sin(x(0)) - d * x(1) * std::abs(x(1));
  }
  void jacobian(double, const StateRef& x, MatrixRef j) const override {
    j << 0.0, 1.0, -w * w * std::cos(x(0)), -2.0 * d * std::abs(x(1));
  }
  Eigen::Index events() const override { return 2; }
  void event_values(double, const StateRef& x, VectorRef g) const override {
    g(0) = x(1);
    g(1) = x(0);
  }
  Eigen::Index parameters() const override { return 2; }
  void rate_by_parameters(double, const StateRef& x, MatrixRef df_dp) const override {
    df_dp(1, 0) = -2.0 * w * std::sin(x(0));
    df_dp(1, 1) = -x(1) * std::abs(x(1));
  }
  double energy(const Eigen::VectorXd& x) const {
    return 0.5 * x(1) * x(1) + w * w * (1.0 - std::cos(x(0)));
  }
};

/// A body that falls: height, speed; the event is the ground.
class Fall : public plant::OdeSystem {
 public:
  double gravity = 9.81;
  Eigen::Index states() const override { return 2; }
  void rate(double, const StateRef& x, VectorRef dx) const override {
    dx(0) = x(1);
    dx(1) = -gravity;
  }
  void jacobian(double, const StateRef&, MatrixRef j) const override { j(0, 1) = 1.0; }
  Eigen::Index events() const override { return 1; }
  void event_values(double, const StateRef& x, VectorRef g) const override { g(0) = x(0); }
};

}  // namespace boresight::reference
