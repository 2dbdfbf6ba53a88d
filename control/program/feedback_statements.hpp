#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/program/digital_sections.hpp>
#include <boresight/control/program/program.hpp>

namespace boresight::control::program {

/// What the feedback reads at a sample, SI at the motor shaft, as expressions.
struct FeedbackInputs {
  Expression angle_error;       // encoder less reference, rad
  Expression rate;              // of the tachometer, rad/s
  Expression rate_feedforward;  // added to the rate command, rad/s
  Expression torque;  // motor torque less that of the commanded motion, N m; unused if not read
};

/// The feedback of a controller as statements. Construction declares its parameters and states.
class FeedbackStatements {
 public:
  FeedbackStatements() = default;
  FeedbackStatements(const FeedbackStatements&) = delete;
  FeedbackStatements& operator=(const FeedbackStatements&) = delete;
  virtual ~FeedbackStatements() = default;

  /// Sets the states to the steady state with this feedback (rad/s of valve command) and these
  /// inputs but the angle error. Returns the angle error of that state.
  virtual Expression start(Builder& builder, const Expression& feedback,
                           const FeedbackInputs& inputs) = 0;
  /// Computes the feedback, rad/s of valve command; states unchanged.
  virtual Expression feedback(Builder& builder, const FeedbackInputs& inputs) = 0;
  /// Advances the states. `cut`: rad/s by which the command's limit reduced the command.
  virtual void advance(Builder& builder, const FeedbackInputs& inputs, const Expression& cut) = 0;
};

/// Loops in sections; `back_calculation`: AntennaController::back_calculation_fraction.
/// @throws InvalidInput as digital_sections.
std::unique_ptr<FeedbackStatements> loop_feedback(Builder& builder, const Controller& controller,
                                                  double sample_time, double back_calculation);

/// A state space in modal blocks. @throws InvalidInput as in_modal_blocks; NumericalFailure for one
/// without a steady state in constant motion.
std::unique_ptr<FeedbackStatements> state_space_feedback(Builder& builder,
                                                         const plant::StateSpace& controller);

}  // namespace boresight::control::program
