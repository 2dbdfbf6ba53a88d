#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boresight/design/commissioning/plant_update.hpp>
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/identification/records/servo_record.hpp>

namespace boresight::design {

/// A stage that is done, and its record.
struct StageRecord {
  std::size_t stage = 0;  // index of the plan's stages
  identification::ServoRecord record;
};

/// What the record of a stage shows, and what it says of the stage.
struct RecordedStage {
  std::size_t stage = 0;
  StageMeasurement measurement;
  std::vector<EvaluatedQuantity> evaluated;
};

struct StageStudyOptions : TrialOptions {
  double motors = 1.0;           // of the drive
  std::size_t fresh_plants = 0;  // on which to try the stages; 0: none
  std::vector<StageRecord> records;
};

/// The stages of a plan before and while they are carried out.
struct StageStudy {
  CommissioningTrials trials;  // without stages: not asked for
  std::vector<FaultTrial> faults;
  std::vector<RecordedStage> records;
  std::optional<PlantUpdate> update;  // by the records; none: nothing was measured
};

/// Tries the stages with usual_faults and on fresh plants (try_stages), evaluates the records and
/// updates the plants by them, from 400 on. Does not depend on the number of threads.
/// @throws InvalidInput for a record of a stage that the plan does not have, and as measure_stage;
/// Interrupted.
StageStudy study_stages(const Mission& mission, const PlantDistribution& distribution,
                        const CommissionStudy& study, const StageStudyOptions& options);

}  // namespace boresight::design
