#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// A thing with a clock that turns measured signals into commands.
class SampledController {
 public:
  SampledController() = default;
  SampledController(const SampledController&) = default;
  SampledController& operator=(const SampledController&) = default;
  SampledController(SampledController&&) = default;
  SampledController& operator=(SampledController&&) = default;
  virtual ~SampledController() = default;

  virtual double sample_time() const = 0;  // s
  /// Observed outputs of the plant that it reads, and, after them, references from outside.
  virtual const std::vector<std::string>& inputs() const = 0;
  /// Inputs of the plant that it drives.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Everything measured before is forgotten.
  virtual void restart() = 0;
  /// The commands (length of outputs()) that follow from the samples taken at `time` (s), in the
  /// order of inputs(). Called once a sample time, in order; must not allocate.
  virtual void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
                      Eigen::Ref<Eigen::VectorXd> commands) = 0;
};

/// A sampled linear law whose commands are held within limits. Beyond a limit the law's states are
/// driven by what the limit left of the command (back calculation, K. J. Astrom, T. Hagglund, PID
/// Controllers, 1995, ch. 3.5), so that integrators do not wind up.
class LinearSampledController final : public SampledController {
 public:
  struct Limits {
    /// Largest magnitude of each output; empty: no limits.
    Eigen::VectorXd largest_command;
    /// How much of each state a command held back by one unit takes off per sample (states x
    /// outputs); empty: nothing.
    Eigen::MatrixXd back_calculation;
  };

  /// @throws InvalidInput as validate(law), for a continuous law, and limits that do not fit or are
  /// not positive.
  explicit LinearSampledController(StateSpace law);
  LinearSampledController(StateSpace law, Limits limits);

  double sample_time() const override { return law_.sample_time; }
  const std::vector<std::string>& inputs() const override { return law_.inputs; }
  const std::vector<std::string>& outputs() const override { return law_.outputs; }
  void restart() override { state_.setZero(); }
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override;

 private:
  StateSpace law_;
  Limits limits_;
  Eigen::VectorXd state_;
  Eigen::VectorXd next_;
  Eigen::VectorXd wanted_;
};

}  // namespace boresight::plant
