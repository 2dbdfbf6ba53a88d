#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/commissioning_records.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// What to plan for.
struct CommissionOptions {
  /// Empty: of the controller that study_controllers recommends; DPF of gains given.
  std::string structure;
  /// The law's gains, KEY=VALUE as [gains] has them; empty: tuned.
  std::vector<std::string> gains;
  double largest_step = 2.0;  // factor on a gain from stage to stage
  int starts = 0;             // of the tuning; 0: as the case has it
  std::uint64_t seed = 1;
  unsigned threads = 1;
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
  double step = 0.0;     // of the command to make: rad/s or rad at the sky, within saturation
  std::string check;     // what to measure, and the values to be expected
  std::string abort;     // beyond what to go back
  std::string way_back;  // how
};

/// One channel of two records of the case.
struct ChannelComparison {
  std::string channel;  // "motor rate less its command", "motor rate", "torque", "valve command"
  std::string unit;     // "rad/s", "N.m"
  /// Why it could not be compared; empty if it was.
  std::string not_compared;
  design::RecordComparison comparison;
  /// Of the rms, after over before, that the plan's first and last stage predict in the design
  /// wind, and over the plants; none where the gains found are not known or the channel is not
  /// predicted.
  std::optional<double> predicted, predicted_lower, predicted_upper;
  bool agrees = false;  // the two intervals meet
};

struct CommissionReport {
  std::string case_path, title, axis;
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
  /// Beam amplitude (rad) by which the law hunts on the nonlinear antenna, where that is beyond the
  /// tightest budget, infinite if it did not complete a run without wind; none where it is not, or
  /// the case has no [simulation].
  std::optional<double> hunting;
  /// What is to be known of gains of a tuned law that ended at a bound of their search.
  std::vector<std::string> bounds;
  std::vector<StageSheet> sheets;
  std::string before, after;
  std::vector<ChannelComparison> comparisons;
  std::vector<std::string> conclusions;
  std::vector<io::Quantity> assumed;
  std::vector<Figure> figures;
};

/// Plans the way to the controller recommended (study_controllers), or to the gains given, and
/// compares two records where asked.
/// @throws InvalidInput for a structure, gains or records that there are none of; Interrupted;
/// InfeasibleRequirement if no law of the structure meets the goals on every plant, or no path to
/// it was found, and NumericalFailure, if no records are compared: else the report holds them.
CommissionReport plan_commission(const io::DesignedAntenna& designed,
                                 const CommissionOptions& options);

/// The comparison of two records of a case by its channels. @throws InvalidInput for a name that no
/// usable record has.
std::vector<ChannelComparison> compare_case_records(const io::Case& antenna,
                                                    const std::string& before,
                                                    const std::string& after, unsigned threads);

/// The report, and as text for a terminal.
Document document_of(const CommissionReport& report);
std::string to_text(const CommissionReport& report);
/// The members of the JSON report; docs/commission.schema.json is made of it.
void describe(io::Visitor& v, const CommissionReport& report);
std::string to_json(const CommissionReport& report);

}  // namespace boresight::app
