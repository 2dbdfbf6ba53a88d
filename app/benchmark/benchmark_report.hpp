#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// What is benchmarked: a controller as control::antenna_state_space_controller takes it.
struct BenchmarkedController {
  plant::StateSpace system;
  std::string description;
  /// The law that the system is the state space of, if it is one: what is not linear is run of laws
  /// only.
  std::optional<control::ControlLaw> law;
  std::vector<std::string> remarks;
};

/// One quantity of two score sheets.
struct ComparedQuantity {
  std::string quantity;  // its place in the JSON score, unit included
  std::optional<double> own, other;
};

/// What of another score sheet is drawn beside one: as its JSON has it.
struct ComparedSheet {
  std::vector<double> frequency, compliance;  // Hz, mdeg/(MN m)
  /// The ladder in this sheet's wind model with the other case's own torque coefficient.
  std::vector<double> wind_speed, beam_rms;  // m/s, mdeg
};

/// A score sheet of `boresight benchmark`.
struct BenchmarkReport {
  std::string case_path, title, axis;
  std::uint64_t seed = 1;
  BenchmarkedController controller;
  bool present_gains = false;  // the controller is what the antenna runs on now, by the case
  double dead_time = 0.0;      // s, of a continuous controller; one sample time of a sampled one
  double gear_ratio = 1.0;
  design::WindCondition wind;
  control::FrequencyBand rms_band;
  design::HardGoals goals;
  /// Whether plant and ensemble are what the case's records show, not what it states.
  bool from_records = false;
  std::string attitudes;  // which were judged, in words
  std::string ensemble_source;
  std::vector<design::PointingBudget> budgets;
  design::RejectionScore score;
  /// Of the beam after 1 N m, 1 N m s at the motor shaft (rad of motor): at most 120 s for plots.
  std::vector<control::CoursePoint> step_course, impulse_course;
  std::optional<TimeDomainSection> time_domain;
  std::string no_time_domain;  // why there is none
  std::vector<io::Quantity> assumed;
  std::string compared_with;  // description of the other sheet; empty: none
  std::vector<ComparedQuantity> comparison;
  std::optional<ComparedSheet> compared_sheet;
  std::vector<Figure> figures;
  bool interrupted = false;
};

struct BenchmarkOptions {
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::function<bool()> interrupted;
  /// Called between parts with those done and all.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// The controller of a law: continuous, or in the sampled form that the antenna's computer runs
/// (sample_time above 0). @throws as control::sampled_law.
BenchmarkedController controller_of(const control::ControlLaw& law, const std::string& description,
                                    double sample_time);

/// Scores a controller on an antenna and its ensemble by the protocol. @throws as
/// design::rejection_benchmark and verify_in_time_domain.
BenchmarkReport benchmark(const io::DesignedAntenna& designed,
                          const BenchmarkedController& controller, const BenchmarkOptions& options);

/// The report, and as text for a terminal.
Document document_of(const BenchmarkReport& report);
std::string to_text(const BenchmarkReport& report);
/// The members of the JSON sheet; docs/benchmark.schema.json is made of it.
void describe(io::Visitor& v, const BenchmarkReport& report);
/// Those of its score alone, which is of a stable loop.
void describe_score(io::Visitor& v, const BenchmarkReport& report);
std::string to_json(const BenchmarkReport& report);

/// Puts another score sheet (JSON of this command) beside the report's. @throws InvalidInput for
/// what is no score sheet, one of an unstable loop and one of another protocol.
void compare_with(BenchmarkReport& report, const std::string& other_json, const std::string& name);

}  // namespace boresight::app
