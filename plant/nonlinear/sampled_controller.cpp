#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/sampled_controller.hpp>

namespace boresight::plant {

LinearSampledController::LinearSampledController(StateSpace controller)
    : LinearSampledController(std::move(controller), Limits{}) {}

LinearSampledController::LinearSampledController(StateSpace controller, Limits limits)
    : controller_(std::move(controller)), limits_(std::move(limits)) {
  validate(controller_);
  const Eigen::Index states = controller_.a.rows();
  const Eigen::Index outputs = controller_.c.rows();
  if (controller_.sample_time == 0.0) {
    throw InvalidInput(
        "sampled controller: expected a sampled controller, found a continuous one; sample() it "
        "first");
  }
  if (limits_.largest_command.size() == 0) {
    limits_.largest_command =
        Eigen::VectorXd::Constant(outputs, std::numeric_limits<double>::infinity());
  }
  if (limits_.back_calculation.size() == 0) {
    limits_.back_calculation = Eigen::MatrixXd::Zero(states, outputs);
  }
  if (limits_.largest_command.size() != outputs || !(limits_.largest_command.array() > 0.0).all()) {
    throw InvalidInput(fmt::format(
        "sampled controller: expected {} command limits above 0, found {} of which the least is {}",
        outputs, limits_.largest_command.size(), limits_.largest_command.minCoeff()));
  }
  if (limits_.back_calculation.rows() != states || limits_.back_calculation.cols() != outputs ||
      !limits_.back_calculation.allFinite()) {
    throw InvalidInput(fmt::format(
        "sampled controller: expected {} x {} finite back-calculation gains, found "
        "{} x {}",
        states, outputs, limits_.back_calculation.rows(), limits_.back_calculation.cols()));
  }
  state_ = next_ = Eigen::VectorXd::Zero(states);
  wanted_ = Eigen::VectorXd::Zero(outputs);
}

void LinearSampledController::update(double /*time*/,
                                     const Eigen::Ref<const Eigen::VectorXd>& measured,
                                     Eigen::Ref<Eigen::VectorXd> commands) {
  wanted_.noalias() = controller_.c * state_;
  wanted_.noalias() += controller_.d * measured;
  commands = wanted_.cwiseMin(limits_.largest_command).cwiseMax(-limits_.largest_command);
  next_.noalias() = controller_.a * state_;
  next_.noalias() += controller_.b * measured;
  wanted_ -= commands;
  next_.noalias() -= limits_.back_calculation * wanted_;
  state_.swap(next_);
}

}  // namespace boresight::plant
