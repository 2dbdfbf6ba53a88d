#pragma once

#include <cstdint>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/identification/records/servo_record.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {

/// The experiment that checks a stage. Steps and moves are on a steady motion, clear of breakaway
/// and velocity reversal. At the motor.
struct StageExperiment {
  double base_rate = 0.0;  // rad/s, of the steady motion
  double step = 0.0;       // rad/s with the position loop open, else rad; up and down
  double step_time = 0.0;  // s, of each, and of the motion before them
  CommandedMove move;      // beyond the steady motion, of a stage with feedforward
};

/// Steps of `step` (as above) or the move. The steady motion is at the step's own rate with the
/// position loop open, so that the rate does not reverse, at the move's rate with feedforward, else
/// at three times the step over its rise time. Two digits, in mdeg/s at the sky; no faster than a
/// fifth of the slew rate, or than leaves the step below half of the rate that the supply sustains.
/// A step lasts five rise times and one and a half settling times, of the slowest plant.
/// @throws InvalidInput without Antenna::nonlinear.
StageExperiment stage_experiment(const Mission& mission, const CommissioningStage& stage,
                                 double step, const CommandedMove& move);

enum class ExperimentPart { command, still_air };

struct StageSimulationOptions {
  /// The step or the move; or still air: a hundred seconds of the steady motion.
  ExperimentPart part = ExperimentPart::command;
  /// What makes the antenna another one than the computer's feedforward is made for.
  std::vector<plant::AntennaChange> changes;
  SignalFactors factors;
  double friction = 1.0;  // factor on the friction torques
  bool noise = true;
  std::uint64_t seed = 1;  // of the noise
};

/// Simulates the experiment on the nonlinear antenna, with all that Antenna::nonlinear states:
/// friction, orifices, limits, backlash, and encoder counts. The controller is sampled, and
/// computes for one sample; with feedforward that of motion, friction and orifice load, as
/// exported. The record holds what the computer reads and commands at its samples, without the
/// first settling time of still air. It has no samples if the run could not be integrated.
/// @throws InvalidInput without Antenna::nonlinear, and as plant::changed.
identification::ServoRecord simulate_stage(const Mission& mission, const CommissioningStage& stage,
                                           const StageExperiment& experiment,
                                           const StageSimulationOptions& options = {});

/// The flow model of a mission's antenna. @throws as stage_experiment.
FlowModel flow_model(const Mission& mission);

/// What the nonlinear antenna adds to the quantities of a step or a move: the experiment without
/// noise, at the stated friction torques and at those of friction_allowance less and more, over
/// what is expected on the nominal linear plant. None where a plant is unstable, or no step is
/// stated.
/// @throws as simulate_stage.
std::vector<ExperimentEffect> experiment_effects(const Mission& mission,
                                                 const CommissioningStage& stage,
                                                 const StageExperiment& experiment);

}  // namespace boresight::design
