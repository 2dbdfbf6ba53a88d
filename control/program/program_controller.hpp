#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/program/controller_program.hpp>
#include <boresight/control/program/interpreter.hpp>

namespace boresight::control::program {

/// A controller_program in place of AntennaController: inputs in SI at the motor shaft are
/// converted to the signals of the antenna's computer and back. The encoder's counts are not
/// rounded; a sensor that does gives whole counts.
class ProgramController final : public StartedController {
 public:
  /// Makes what executes a program; without one, the Interpreter in double precision does.
  using MakeRunner = std::function<std::unique_ptr<Runner>(const Program& program)>;

  /// @throws as controller_program.
  ProgramController(const Controller& controller, double sample_time,
                    const ControllerProgramOptions& options, const MakeRunner& runner = nullptr);
  // The runner refers to the program.
  ProgramController(const ProgramController&) = delete;
  ProgramController& operator=(const ProgramController&) = delete;
  ~ProgramController() override = default;

  double sample_time() const override { return program_.sample_time; }
  const std::vector<std::string>& inputs() const override { return inputs_; }
  const std::vector<std::string>& outputs() const override { return outputs_; }
  void restart() override;
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override;
  double start_from(const SteadyMotion& motion) override;

  const Program& program() const { return program_; }

 private:
  void step(Runner& runner, double tachometer, double encoder, double torque, double target,
            double target_rate) const;
  Interpreter started_at(double reference) const;

  ControllerProgramOptions options_;
  Program program_;
  std::unique_ptr<Runner> runner_;
  std::size_t counts_, tachometer_, torque_ = 0, target_angle_, target_rate_, command_, error_;
  bool reads_torque_;
  std::vector<std::string> inputs_, outputs_;
  SteadyMotion motion_;
  double lead_ = 0.0;   // rad of motor
  bool waits_ = false;  // for the first reference, at which it starts
};

}  // namespace boresight::control::program
