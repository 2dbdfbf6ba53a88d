#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/stage_simulation.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/studies/controller_study.hpp>

namespace boresight::design {

/// The stages from a present controller to a new one, with the on-site checks of each stage.
struct CommissionStudy {
  TrackingProblem problem;
  CommandedMove move;  // of the last stages, at the motor shaft
  CommissioningPlan plan;
  /// Command step of each stage of the plan, at the sky: rad/s with the position loop open, else
  /// rad. Each is 1, 2 or 5 times a power of ten in mdeg. On every plant the step takes at most a
  /// fifth of the valve's stroke and of the supply's torque. It is at most a fifth of the slew
  /// rate, or 100 mdeg. NaN where a plant is unstable.
  std::vector<double> steps;
  /// How each stage is checked: those steps, or the move, on a steady motion. Its effects and flow
  /// (CommissioningStage) are those of the nonlinear antenna. Empty without Antenna::nonlinear, and
  /// effects and flow too.
  std::vector<StageExperiment> experiments;
  /// Boresight amplitude (rad) of the controller's limit cycle on the nonlinear antenna, if it
  /// exceeds the allowed one. Infinite if a run without wind did not complete. None if it does not
  /// exceed it, and without Antenna::nonlinear.
  std::optional<double> limit_cycle;
};

/// The controller of a study that commissioning stages can lead to: the recommended one, which may
/// miss a budget but no more. It must be tuned to meet every constraint on every ensemble member.
/// Null if there is none.
const TunedController* commissionable(const ControllerStudy& study);

/// A gain that acts in a stage. With the position loop open, the gains of the position and
/// compliance paths do not act.
struct ActingGain {
  std::size_t place = 0;  // index into the controller's gains
  /// Relative to the stage before: its value differs, or it did not act there.
  bool changed = false;
};

/// The acting gains in the controller's order. `before`: the stage before; null for the first
/// stage, whose gains all count as unchanged.
std::vector<ActingGain> acting_gains(const StageController& stage, const StageController* before);

/// The move that checks the last stages, feasible on every antenna: a twentieth of the slew rate,
/// reached in two seconds. At the motor shaft.
CommandedMove commissioning_move(const Mission& mission);

/// Plans the stages from the first of the mission's present controllers to `target`, on every
/// member of the ensemble. The result does not depend on the number of threads. @throws as
/// plan_commissioning.
CommissionStudy study_commission(const Mission& mission, const PlantEnsemble& ensemble,
                                 const control::Controller& target,
                                 const CommissioningOptions& options, std::uint64_t seed);

}  // namespace boresight::design
