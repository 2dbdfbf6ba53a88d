#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/commissioning/stage_quantities.hpp>
#include <boresight/design/commissioning/stage_simulation.hpp>
#include <boresight/design/commissioning/trial_antenna.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/problem/mission.hpp>

namespace boresight::design {

/// One stage on plants that are as the uncertainty set says.
struct StageTrial {
  std::size_t plants = 0;
  std::size_t stable = 0;   // by eigenvalues
  std::size_t passing = 0;  // stable, and every quantity within its pass interval
  std::size_t aborted = 0;  // unstable or beyond an abort limit: on these plants a false alarm
  /// The quantity that leaves its interval most often, and on how many plants.
  std::optional<StageQuantity> worst;
  std::size_t worst_outside = 0;
};

/// The stages, in order, and the plants on which the whole way goes as planned, but for the stage
/// as found.
struct CommissioningTrials {
  std::vector<StageTrial> stages;
  std::size_t plants = 0;
  std::size_t stable = 0;   // in every stage
  std::size_t passing = 0;  // every check of every stage
  std::size_t aborted = 0;  // at least one stage
};

/// Runs every stage of a plan on `count` plants drawn from the distribution, other ones than those
/// of an ensemble of the same seed. The same for any number of threads. Takes 20 ms per stage and
/// plant. @throws InvalidInput without plants, and as plant::changed; Interrupted.
CommissioningTrials try_stages(const Mission& mission, const PlantDistribution& distribution,
                               const CommissioningPlan& plan, const CommandedMove& move,
                               std::size_t count, const TrialOptions& options);

/// An antenna that is not as stated: built, scaled or wired otherwise.
struct AntennaFault {
  std::string name;
  std::vector<plant::AntennaChange> changes;
  SignalFactors factors;
};

/// What is wrong most often: oil stiffness halved and doubled (air, other oil volume), a motor of
/// `motors` with half its displacement, motors of twice the inertia, structure a quarter softer,
/// valve at half and twice the stated gain and with the wrong sign, tachometer at half and twice
/// its scale and with the wrong sign, encoder with the wrong sign, and, where the controller feeds
/// torque back, torque with the wrong sign. @throws InvalidInput for less than one motor.
std::vector<AntennaFault> usual_faults(double motors, bool feeds_torque_back);

/// A fault in the stages of a plan, which end with the first that does not pass.
struct FaultTrial {
  std::string fault;
  /// Index of the stage that shows it: its verdict is not passes. None: no stage does.
  std::optional<std::size_t> detected;
  StageEvaluation evaluation;  // of that stage
  double measured = 0.0;       // what it shows of evaluation.worst
};

/// Runs the stages, but for the one as found, on the antenna with each fault. What is shown is the
/// antenna as the engineer measures it, the stated sensors' noise included. With `experiments`, one
/// a stage, steps and moves are those of the nonlinear antenna (simulate_stage), evaluated as a
/// record of the stage is; without, those of the linear plant. Takes up to a second per stage and
/// fault then.
std::vector<FaultTrial> try_faults(const Mission& mission, const CommissioningPlan& plan,
                                   const CommandedMove& move,
                                   const std::vector<AntennaFault>& faults,
                                   const TrialOptions& options,
                                   const std::vector<StageExperiment>& experiments = {});

}  // namespace boresight::design
