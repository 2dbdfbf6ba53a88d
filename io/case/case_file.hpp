#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/section.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// One antenna axis as a case file describes it. The types of the sections are in the headers that
/// case_declaration.hpp lists.
struct Case {
  Case();
  Case(const Case& other);
  Case(Case&& other) noexcept;
  Case& operator=(const Case& other);
  Case& operator=(Case&& other) noexcept;
  ~Case();

  std::string path;
  std::string title;
  std::string axis;
  Section<AntennaEntry> antenna;
  Section<GearTrainEntry> gear_train;
  Section<MotorEntry> motor;
  Section<OilEntry> oil;
  Section<ResonanceEntry> resonance;
  /// If it has a voltage and a recorder limit; see campaign for one of another kind.
  OptionalSection<TachometerEntry> tachometer;
  Section<FrictionTestsEntry> friction_tests;
  std::vector<ImpulseResult> impulse_results;
  Section<DriveEntry> drive;
  Section<FrictionCurveEntry> friction_curve;
  Section<StructureEntry> structure;
  OptionalSection<SimulationEntry> simulation;
  OptionalSection<RecorderEntry> recorder;
  Section<SensorsEntry> sensors;
  Section<ControllerEntry> controller;
  OptionalSection<ComputerEntry> computer;
  Section<WindEntry> wind;
  std::vector<BandEntry> bands;
  std::vector<BudgetEntry> budgets;
  Section<GoalsEntry> goals;
  std::vector<LoopEntry> loops;
  OptionalSection<PresentGainsEntry> present_gains;
  Section<EnsembleEntry> ensemble;
  Section<TuningEntry> tuning;
  Section<MatchingEntry> matching;
  std::vector<StatedEntry> stated;
  std::vector<RemarkEntry> remarks;
  /// The recorded tests and the instruments.
  Section<CampaignEntry> campaign;
  /// Every quantity of the file, in file order, for the list of assumptions.
  std::vector<Quantity> quantities;
};

/// Reads and checks a case file. @throws InvalidInput with one message: file, line, column, key,
/// what was expected and what was found.
Case read_case(const std::string& path);
/// Same, of a text; files that it names stand relative to the path's folder.
Case parse_case(std::string_view text, const std::string& path);

}  // namespace boresight::io
