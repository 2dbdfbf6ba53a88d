#include <fmt/format.h>

#include <boresight/design/studies/stage_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

// More are drawn where the records leave few of them.
constexpr std::size_t updated_from = 400;

void check(const CommissioningPlan& plan, const std::vector<StageRecord>& records) {
  for (const StageRecord& record : records) {
    if (record.stage < plan.stages.size()) continue;
    throw InvalidInput(fmt::format("{}: expected a stage of the plan, 1 to {}, found {}",
                                   record.record.name, plan.stages.size(), record.stage + 1));
  }
}

}  // namespace

StageStudy study_stages(const Mission& mission, const PlantDistribution& distribution,
                        const CommissionStudy& study, const StageStudyOptions& options) {
  const CommissioningPlan& plan = study.plan;
  check(plan, options.records);
  StageStudy result;
  const bool torque = plan.stages.back().controller.controller.structure.feeds_torque_back();
  const auto faults = usual_faults(options.motors, torque);
  result.faults = try_faults(mission, plan, study.move, faults, options, study.experiments);
  if (options.fresh_plants > 0) {
    result.trials =
        try_stages(mission, distribution, plan, study.move, options.fresh_plants, options);
  }
  std::vector<MeasuredStage> measured;
  bool any = false;
  for (const auto& [number, record] : options.records) {
    const CommissioningStage& stage = plan.stages[number];
    const auto measurement = measure_stage(record, stage, study.problem.gear_ratio);
    result.records.push_back(
        {number, measurement, evaluated(measurement, stage, options.rms_allowance)});
    measured.push_back({number, measurement});
    any = any || !measurement.quantities.empty();
  }
  if (any) {
    result.update = updated_plants(mission, distribution, plan, study.move, measured, faults,
                                   updated_from, options);
  }
  return result;
}

}  // namespace boresight::design
