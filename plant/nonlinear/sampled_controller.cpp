#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/sampled_controller.hpp>

namespace boresight::plant {

LinearSampledController::LinearSampledController(StateSpace law)
    : LinearSampledController(std::move(law), Limits{}) {}

LinearSampledController::LinearSampledController(StateSpace law, Limits limits)
    : law_(std::move(law)), limits_(std::move(limits)) {
  validate(law_);
  const Eigen::Index states = law_.a.rows();
  const Eigen::Index outputs = law_.c.rows();
  if (law_.sample_time == 0.0) {
    throw InvalidInput(
        "sampled controller: expected a sampled law, found a continuous one; sample() it first");
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
  wanted_.noalias() = law_.c * state_;
  wanted_.noalias() += law_.d * measured;
  commands = wanted_.cwiseMin(limits_.largest_command).cwiseMax(-limits_.largest_command);
  next_.noalias() = law_.a * state_;
  next_.noalias() += law_.b * measured;
  wanted_ -= commands;
  next_.noalias() -= limits_.back_calculation * wanted_;
  state_.swap(next_);
}

}  // namespace boresight::plant
