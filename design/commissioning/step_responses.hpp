#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::design {

/// A change of the command: `first` is its last sample before it, `behind` the first after it.
struct CommandStep {
  Eigen::Index first = 0, behind = 0;
};

/// True for a command at rest or in steady motion, also one in the steps of its resolution: off a
/// straight line by rounding, or by three of its smallest changes, of which there are 20 or more,
/// nine tenths of them in one direction. `command`: 2 samples or more.
bool is_steady(const Eigen::VectorXd& command);

/// The steps of a command: changes over ten samples at most, above half of the largest one and
/// above 20 times its usual change. A longer change is a motion. `command`: 2 samples or more.
std::vector<CommandStep> steps_of(const Eigen::VectorXd& command);

/// Responses over their steps, on the samples of the shortest.
struct StepResponses {
  std::vector<Eigen::VectorXd> single;
  double noise = 0.0;       // standard, before the steps, over the step
  double size = 0.0;        // mean of the steps' sizes
  std::size_t masked = 0;   // left out: samples that are not valid
  std::size_t hurried = 0;  // left out: shorter than `min_length`, or too soon after the one before
};

/// The motion before a step is the command's, in the half of the time before it in which the step
/// before has decayed; it is taken off command and response. `min_length`: samples of a step.
StepResponses step_responses(const identification::Signal& command,
                             const identification::Signal& response,
                             const std::vector<CommandStep>& steps, Eigen::Index min_length);

/// Whether `count` samples from `first` are valid.
bool all_valid(const identification::Signal& signal, Eigen::Index first, Eigen::Index count);

}  // namespace boresight::design
