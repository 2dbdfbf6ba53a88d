#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/studies/controller_study.hpp>

namespace boresight::design {

/// The way to a controller, with what shows on site whether a stage works.
struct CommissionStudy {
  TrackingProblem problem;
  CommandedMove move;  // of the last stages, at the motor
  CommissioningPlan plan;
  /// Of each stage of the plan the step of the command to make (at the sky: rad/s with the position
  /// loop open, else rad): 1, 2 or 5 times a power of ten in mdeg, so that no plant takes more than
  /// a fifth of the valve's stroke or of the supply's torque; at most a fifth of the slew rate, or
  /// 100 mdeg. NaN where a plant is unstable.
  std::vector<double> steps;
  /// Beam amplitude (rad) of the controller's limit cycle on the nonlinear antenna, where that is
  /// beyond the tightest budget, infinite if it did not complete a run without wind; none where it
  /// is not, or without Antenna::nonlinear.
  std::optional<double> limit_cycle;
};

/// Of a study the controller that stages can lead to: recommended, where only a loss in wind is
/// accepted, and tuned to meet every constraint on every plant that may be the true one. Null if
/// there is none.
const TunedLaw* commissionable(const ControllerStudy& study);

/// A gain that acts in a stage: with the position loop open those of position and compliance path
/// rest.
struct ActingGain {
  std::size_t place = 0;  // in the law's gains
  /// Against the stage before: it has another value, or did not act.
  bool changed = false;
};

/// The acting gains in the law's order. `before`: the stage before, null for the first, in which
/// nothing is changed.
std::vector<ActingGain> acting_gains(const StageLaw& stage, const StageLaw* before);

/// The move by which the last stages are checked, which any antenna makes: a twentieth of the slew
/// rate, reached in two seconds. At the motor.
CommandedMove commissioning_move(const Mission& mission);

/// Plans the way from the first of the mission's present controllers to `target`, on every member
/// of the ensemble. The same for any number of threads. @throws as plan_commissioning.
CommissionStudy study_commission(const Mission& mission, const PlantEnsemble& ensemble,
                                 const control::ControlLaw& target,
                                 const CommissioningOptions& options, std::uint64_t seed);

}  // namespace boresight::design
