#pragma once

namespace boresight::io {

/// One antenna axis as a case file describes it (case_file.hpp). Each section has a header of its
/// own; a source includes those that it reads.
struct Case;

// case_mechanics.hpp
struct RotatingAssembly;
struct GearTrainEntry;
struct AntennaAlternative;
struct AntennaEntry;
// case_motor.hpp
struct MotorEntry;
// case_oil.hpp
struct OilEntry;
// case_tests.hpp
struct ResonanceEntry;
struct TachometerEntry;
struct FrictionTestsEntry;
struct ImpulseResult;
// case_drive.hpp
struct DriveEntry;
// case_friction.hpp
struct FrictionCurveEntry;
// case_structure.hpp
struct StructureModeEntry;
struct StructureEntry;
// case_simulation.hpp
struct SimulationEntry;
struct RecorderEntry;
// case_sensors.hpp
struct SensorsEntry;
struct ControllerEntry;
// case_computer.hpp
struct ComputerEntry;
// case_wind.hpp
struct WindEntry;
// case_pointing.hpp
struct BandEntry;
struct BudgetEntry;
// case_goals.hpp
struct GoalsEntry;
struct MatchingEntry;
// case_tuning.hpp
struct LoopEntry;
struct PresentGainsEntry;
struct EnsembleEntry;
struct TuningEntry;
// case_statements.hpp
struct StatedEntry;
struct RemarkEntry;
// case_campaign.hpp
struct RecordEntry;
struct RecordColumnsEntry;
struct CampaignEntry;

}  // namespace boresight::io
