#include <map>

#include <fmt/format.h>

#include <boresight/design/commissioning/commissioning_trials.hpp>
#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

// Ensembles take the samples from 0.
constexpr std::uint64_t first_fresh_sample = 1'000'000;

// A quantity and what an antenna shows of it, the worst of the stage.
struct MeasuredOnAntenna {
  StageEvaluation evaluation;
  double measured = 0.0;
};

MeasuredOnAntenna on_linear_plant(const StageObservation& seen, const CommissioningStage& stage,
                                  double rms_allowance) {
  MeasuredOnAntenna shown{evaluated(seen, stage, rms_allowance)};
  if (shown.evaluation.worst) shown.measured = value_of(*shown.evaluation.worst, seen);
  return shown;
}

// Steps and moves by a record; the rms in still air are those of the linear plant.
MeasuredOnAntenna on_nonlinear_antenna(const Mission& mission, const CommissioningStage& stage,
                                       const StageExperiment& experiment, const AntennaFault& fault,
                                       const StageObservation& seen, const TrialOptions& trial) {
  const double rms_allowance = trial.rms_allowance;
  MeasuredOnAntenna shown;
  auto& evaluation = shown.evaluation;
  evaluation.stable = seen.stable;
  evaluation.verdict = StageVerdict::abort;
  if (!seen.stable) return shown;
  StageSimulationOptions options;
  options.changes = fault.changes;
  options.factors = fault.factors;
  options.seed = trial.seed;
  const auto record = simulate_stage(mission, stage, experiment, options);
  evaluation.stable = record.motor_rate->values.size() > 0;
  if (!evaluation.stable) return shown;
  const auto measured = evaluated(measure_stage(record, stage, plant::gear_ratio(mission.antenna)),
                                  stage, rms_allowance);
  evaluation.verdict = worst_verdict(measured);
  for (const EvaluatedQuantity& one : measured) {
    if (one.verdict == StageVerdict::passes) continue;
    evaluation.outside.push_back(one.measured.quantity);
    if (!evaluation.worst && one.verdict == evaluation.verdict) {
      evaluation.worst = one.measured.quantity;
      shown.measured = one.measured.value;
    }
  }
  for (const StageQuantity quantity : measured_quantities(stage)) {
    if (!is_rms(quantity)) continue;
    const double value = value_of(quantity, seen);
    const StageVerdict verdict = verdict_on(quantity, value, 0.0, stage, rms_allowance);
    if (verdict != StageVerdict::passes) evaluation.outside.push_back(quantity);
    if (verdict <= evaluation.verdict) continue;
    evaluation.verdict = verdict;
    evaluation.worst = quantity;
    shown.measured = value;
  }
  return shown;
}

}  // namespace

CommissioningTrials try_stages(const Mission& mission, const PlantDistribution& distribution,
                               const CommissioningPlan& plan, const CommandedMove& move,
                               std::size_t count, const TrialOptions& options) {
  if (count < 1) throw InvalidInput("try_stages: expected at least one plant, found none");
  const TrialAntenna antenna(mission, move);
  std::vector<std::vector<StageEvaluation>> outcomes(count);
  for_each_plant(0, count, options, [&](std::size_t i) {
    StageObserver observer =
        antenna.observer(changes_of(distribution.draw(options.seed, first_fresh_sample + i)));
    for (const auto& stage : plan.stages) {
      outcomes[i].push_back(
          evaluated(observer.observe(stage.controller), stage, options.rms_allowance));
    }
  });
  CommissioningTrials trials;
  trials.stages.resize(plan.stages.size());
  trials.plants = count;
  for (const auto& plant : outcomes) {
    bool stable = true, passing = true, aborted = false;
    for (std::size_t k = 0; k < plant.size(); ++k) {
      if (plan.stages[k].kind == StageKind::as_found) continue;
      stable = stable && plant[k].stable;
      passing = passing && plant[k].verdict == StageVerdict::passes;
      aborted = aborted || plant[k].verdict == StageVerdict::abort;
    }
    trials.stable += stable ? 1 : 0;
    trials.passing += passing ? 1 : 0;
    trials.aborted += aborted ? 1 : 0;
  }
  for (std::size_t k = 0; k < trials.stages.size(); ++k) {
    StageTrial& trial = trials.stages[k];
    std::map<StageQuantity, std::size_t> outside;
    for (const auto& plant : outcomes) {
      const StageEvaluation& outcome = plant[k];
      ++trial.plants;
      trial.stable += outcome.stable ? 1 : 0;
      trial.passing += outcome.verdict == StageVerdict::passes ? 1 : 0;
      trial.aborted += outcome.verdict == StageVerdict::abort ? 1 : 0;
      for (const StageQuantity quantity : outcome.outside) ++outside[quantity];
    }
    for (const auto& [quantity, plants] : outside) {
      if (plants <= trial.worst_outside) continue;
      trial.worst = quantity;
      trial.worst_outside = plants;
    }
  }
  return trials;
}

std::vector<AntennaFault> usual_faults(double motors, bool feeds_torque_back) {
  if (!(motors >= 1.0)) {
    throw InvalidInput(fmt::format("usual_faults: expected one motor or more, found {}", motors));
  }
  // Of all motors' displacement what is left, and of their stiffness, which goes with its square.
  const double displacement = (motors - 0.5) / motors;
  const double stiffness = (motors - 0.75) / motors;
  std::vector<AntennaFault> faults{
      {"oil stiffness halved", {plant::scaled_by("at_shaft.oil_stiffness", 0.5)}, {}},
      {"oil stiffness doubled", {plant::scaled_by("at_shaft.oil_stiffness", 2.0)}, {}},
      // The valve's oil turns the motors faster, and the same pressures are less torque than shown.
      {"one motor with half its displacement",
       {plant::scaled_by("at_shaft.oil_stiffness", stiffness)},
       {.valve = 1.0 / displacement, .torque = 1.0 / displacement}},
      {"motors with twice the inertia", {plant::scaled_by("at_shaft.motor_inertia", 2.0)}, {}},
      {"structural frequencies a quarter lower",
       {plant::scaled_by("structure.frequencies", 0.75)},
       {}},
      {"valve gain halved", {}, {.valve = 0.5}},
      {"valve gain doubled", {}, {.valve = 2.0}},
      {"valve with the wrong sign", {}, {.valve = -1.0}},
      {"tachometer scale halved", {}, {.tachometer = 0.5}},
      {"tachometer scale doubled", {}, {.tachometer = 2.0}},
      {"tachometer with the wrong sign", {}, {.tachometer = -1.0}},
      {"encoder with the wrong sign", {}, {.encoder = -1.0}}};
  if (feeds_torque_back) {
    faults.push_back({"torque with the wrong sign", {}, {.torque = -1.0}});
  }
  return faults;
}

std::vector<FaultTrial> try_faults(const Mission& mission, const CommissioningPlan& plan,
                                   const CommandedMove& move,
                                   const std::vector<AntennaFault>& faults,
                                   const TrialOptions& options,
                                   const std::vector<StageExperiment>& experiments) {
  const TrialAntenna antenna(mission, move);
  std::vector<FaultTrial> trials(faults.size());
  for_each_plant(0, faults.size(), options, [&](std::size_t i) {
    FaultTrial& trial = trials[i];
    trial.fault = faults[i].name;
    StageObserver observer = antenna.observer(faults[i].changes, faults[i].factors);
    for (std::size_t k = 0; k < plan.stages.size() && !trial.detected; ++k) {
      const CommissioningStage& stage = plan.stages[k];
      if (stage.kind == StageKind::as_found) continue;
      const StageObservation seen = observer.observe(stage.controller);
      const MeasuredOnAntenna shown =
          k < experiments.size()
              ? on_nonlinear_antenna(mission, stage, experiments[k], faults[i], seen, options)
              : on_linear_plant(seen, stage, options.rms_allowance);
      if (shown.evaluation.verdict == StageVerdict::passes) continue;
      trial.detected = k;
      trial.evaluation = shown.evaluation;
      trial.measured = shown.measured;
    }
  });
  return trials;
}

}  // namespace boresight::design
