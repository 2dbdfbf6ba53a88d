#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_ode.hpp>

namespace boresight::plant {

FeedbackOde::FeedbackOde(const FeedbackSystem& system)
    : matrices_(feedback_matrices(system)),
      channels_(system.channels),
      u_(Eigen::VectorXd::Zero(matrices_.input.cols())),
      z_(Eigen::VectorXd::Zero(system.channel_inputs)),
      n_(Eigen::VectorXd::Zero(system.channel_outputs)),
      slope_(Eigen::MatrixXd::Zero(system.channel_outputs, system.channel_inputs)) {}

void FeedbackOde::drive(double t0, const Eigen::VectorXd& u0, double t1,
                        const Eigen::VectorXd& u1) {
  if (u0.size() != u_.size() || u1.size() != u_.size() || !u0.allFinite() || !u1.allFinite()) {
    throw InvalidInput(fmt::format(
        "FeedbackOde: expected {} finite inputs at both times, found {} and {}{}", u_.size(),
        u0.size(), u1.size(), u0.allFinite() && u1.allFinite() ? "" : ", not all finite"));
  }
  if (!std::isfinite(t0) || !std::isfinite(t1) || t0 == t1) {
    throw InvalidInput(
        fmt::format("FeedbackOde: expected two times that differ, found {} s and {} s", t0, t1));
  }
  input_ = [t0, u0, slope = Eigen::VectorXd((u1 - u0) / (t1 - t0))](
               double t, Eigen::Ref<Eigen::VectorXd> u) { u = u0 + (t - t0) * slope; };
}

void FeedbackOde::evaluate(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const {
  if (input_) input_(t, u_);
  if (!channels_) return;
  z_.noalias() = matrices_.channel_output * x;
  z_.noalias() += matrices_.input_to_channels * u_;
  channels_->evaluate(z_, n_, slope_);
}

void FeedbackOde::rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                       Eigen::Ref<Eigen::VectorXd> dx) const {
  evaluate(t, x);
  dx.noalias() = matrices_.a * x;
  dx.noalias() += matrices_.input * u_;
  dx.noalias() += matrices_.channel_input * n_;
}

void FeedbackOde::jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                           Eigen::Ref<Eigen::MatrixXd> j) const {
  evaluate(t, x);
  j = matrices_.a;
  j.noalias() += matrices_.channel_input * slope_ * matrices_.channel_output;
}

Eigen::VectorXd FeedbackOde::outputs(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const {
  evaluate(t, x);
  return matrices_.output * x + matrices_.input_to_output * u_ + matrices_.channels_to_output * n_;
}

}  // namespace boresight::plant
