#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boresight/app/commission/stage_checks.hpp>
#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/drive_record_comparison.hpp>
#include <boresight/design/studies/stage_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/pointing_axis.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// What to plan for.
struct CommissionOptions {
  /// Empty: of the controller that study_controllers recommends; DPF of gains given.
  std::string structure;
  /// Gains of the controller, KEY=VALUE as in [gains], or one path of a file with gains; empty:
  /// tuned.
  std::vector<std::string> gains;
  std::string controller_path;  // of a state space instead of gains; empty: none
  /// Instead of both: the controller itself, of `structure` in words.
  std::optional<control::Controller> controller;
  double largest_step = 2.0;  // factor on a gain from stage to stage
  int starts = 0;             // of the tuning; 0: as the case has it
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::size_t plants = 0;  // fresh ones to try the stages on; 0: none
  /// Stages that are done, by their number from 1, and the file of the record of each.
  std::vector<std::pair<std::size_t, std::string>> records;
  /// Names of records of the case, both or none.
  std::string before, after;
  std::function<bool()> interrupted;
  /// Called with what is being worked on ("tuning", "planning"), parts of it done and all.
  std::function<void(std::string_view, std::size_t, std::size_t)> progress;
};

/// A gain of a stage.
struct StageGain {
  std::string symbol, name;
  std::string text;      // in the case's units
  double value = 0.0;    // SI
  bool changed = false;  // against the stage before
};

/// One stage as an engineer reads it.
struct StageSheet {
  design::CommissioningStage stage;
  std::vector<StageGain> gains;  // those that act
  double step = 0.0;  // of the command to make: rad/s or rad at the sky, within saturation
  /// The steady motion of step or move, and how long each step lasts. At the motor; none without
  /// [simulation] of the case.
  std::optional<design::StageExperiment> experiment;
  std::vector<StageCheck> checks;  // what to measure
  std::string reserve;             // what the abort limits leave of the loop gain
  std::string way_back;            // beyond an abort limit
};

/// The record of a stage that is done.
struct RecordedStage : design::RecordedStage {
  std::string file;
  std::vector<std::string> remarks;  // of reading and measuring it
};

/// One quantity of two records of the case.
struct ChannelComparison : design::QuantityComparison {
  std::optional<design::RatioBand> predicted;  // predicted_ratio of the plan
};

struct CommissionReport {
  std::string case_path, title;
  io::PointingAxis axis;
  std::uint64_t seed = 1;
  std::string structure;
  bool tuned = false;  // else the gains were given
  std::string ensemble_source;
  std::size_t ensemble_size = 0;
  double wind_speed = 0.0;
  std::string wind_model;
  double gear_ratio = 1.0;
  design::CommandedMove move;  // at the motor
  design::CommissioningOptions options;
  design::CommissioningPlan plan;
  /// Why there is no plan (InfeasibleRequirement, NumericalFailure), and that in words; none: there
  /// is one.
  std::exception_ptr failure;
  std::string no_plan;
  std::optional<double> limit_cycle;  // CommissionStudy::limit_cycle
  /// Remarks on the gains of a tuned controller that lie at a bound of their search range.
  std::vector<std::string> bounds;
  std::vector<StageSheet> sheets;
  PlantUnits units;
  design::CommissioningTrials trials;  // on fresh plants; without stages: not asked for
  std::vector<design::FaultTrial> faults;
  std::vector<RecordedStage> records;
  std::optional<design::PlantUpdate> update;  // by the records; none: nothing was measured
  std::string before, after;
  std::vector<ChannelComparison> comparisons;
  std::vector<std::string> conclusions;
  std::vector<io::Quantity> assumed;
  std::vector<Figure> figures;
};

/// Plans the path to the recommended controller (study_controllers), or to the given one. Tries
/// the stages on fresh plants and on antennas with usual_faults, evaluates records of stages that
/// are done, and compares two records, where requested.
/// @throws InvalidInput for an unknown structure, unknown gains, missing records or a record of a
/// stage that the plan does not have; Interrupted.
/// InfeasibleRequirement if no controller of the structure is recommended and meets the constraints
/// on every plant, or no path to it was found. NumericalFailure. With compared records, the report
/// holds the last two errors instead.
CommissionReport plan_commission(const io::DesignedAntenna& designed,
                                 const CommissionOptions& options);

/// The report, and as text for a terminal.
Document document_of(const CommissionReport& report);
std::string to_text(const CommissionReport& report);
/// The members of the JSON report, from which docs/commission.schema.json is generated.
void describe(io::Visitor& v, const CommissionReport& report);
std::string to_json(const CommissionReport& report);

}  // namespace boresight::app
