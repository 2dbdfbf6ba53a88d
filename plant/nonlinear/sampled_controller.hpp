#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// A controller with a clock that computes commands from measured signals.
class SampledController {
 public:
  SampledController() = default;
  SampledController(const SampledController&) = default;
  SampledController& operator=(const SampledController&) = default;
  SampledController(SampledController&&) = default;
  SampledController& operator=(SampledController&&) = default;
  virtual ~SampledController() = default;

  virtual double sample_time() const = 0;  // s
  /// Observed outputs of the plant that it reads, followed by external references.
  virtual const std::vector<std::string>& inputs() const = 0;
  /// Inputs of the plant that it drives.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Discards all earlier measurements.
  virtual void restart() = 0;
  /// Computes the commands (length of outputs()) from the samples taken at `time` (s), in the order
  /// of inputs(). Called once per sample time, in order; must not allocate.
  virtual void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
                      Eigen::Ref<Eigen::VectorXd> commands) = 0;
};

/// A sampled linear controller with limited commands. Beyond a limit its states are driven by the
/// difference between limited and computed command, which prevents integrator windup (back
/// calculation, K. J. Astrom, T. Hagglund, PID Controllers, 1995, ch. 3.5).
class LinearSampledController final : public SampledController {
 public:
  struct Limits {
    /// Largest magnitude of each output; empty: no limits.
    Eigen::VectorXd largest_command;
    /// Reduction of each state per sample and per unit of limited command (states x outputs);
    /// empty: none.
    Eigen::MatrixXd back_calculation;
  };

  /// @throws InvalidInput as `validate`, for a continuous controller, and for limits of the wrong
  /// size or not positive.
  explicit LinearSampledController(StateSpace controller);
  LinearSampledController(StateSpace controller, Limits limits);

  double sample_time() const override { return controller_.sample_time; }
  const std::vector<std::string>& inputs() const override { return controller_.inputs; }
  const std::vector<std::string>& outputs() const override { return controller_.outputs; }
  void restart() override { state_.setZero(); }
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override;

 private:
  StateSpace controller_;
  Limits limits_;
  Eigen::VectorXd state_;
  Eigen::VectorXd next_;
  Eigen::VectorXd wanted_;
};

}  // namespace boresight::plant
