#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/studies/benchmark_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/pointing_axis.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// One quantity of two score sheets.
struct ComparedQuantity {
  std::string quantity;  // its place in the JSON score, unit included
  std::optional<double> own, other;
};

/// The data of another score sheet that are drawn for comparison, as in its JSON.
struct ComparedSheet {
  std::vector<double> frequency, compliance;  // Hz, mdeg/(MN m)
  /// The ladder in this sheet's wind model with the other case's own torque coefficient.
  std::vector<double> wind_speed, boresight_rms;  // m/s, mdeg
};

/// A score sheet of `boresight benchmark`.
struct BenchmarkReport : design::BenchmarkStudy {
  std::string case_path, title;
  io::PointingAxis axis;
  std::uint64_t seed = 1;
  /// Of the controller's file, and on a sample time that differs from the case's delay.
  std::vector<std::string> remarks;
  /// Whether plant and ensemble are what the case's records show, not what it states.
  bool from_records = false;
  std::string attitudes_text;  // which were evaluated, in words
  std::string ensemble_source;
  std::optional<TimeDomainSection> time_domain;
  std::string no_time_domain;  // why there is none
  std::vector<io::Quantity> assumed;
  std::string compared_with;  // description of the other sheet; empty: none
  std::vector<ComparedQuantity> comparison;
  std::optional<ComparedSheet> compared_sheet;
  std::vector<Figure> figures;
};

/// design::study_rejection of the antenna, in words. `remarks`: of the controller's file.
/// @throws as design::study_rejection.
BenchmarkReport benchmark(const io::DesignedAntenna& designed,
                          const design::BenchmarkedController& controller,
                          const std::vector<std::string>& remarks,
                          const design::BenchmarkOptions& options);

/// The report, and as text for a terminal.
Document document_of(const BenchmarkReport& report);
std::string to_text(const BenchmarkReport& report);
/// The members of the JSON sheet, from which docs/benchmark.schema.json is generated.
void describe(io::Visitor& v, const BenchmarkReport& report);
/// Those of its score alone, which is of a stable loop.
void describe_score(io::Visitor& v, const BenchmarkReport& report);
std::string to_json(const BenchmarkReport& report);

/// Adds another score sheet (JSON of this command) for comparison.
/// @throws InvalidInput for anything but a score sheet, one of an unstable loop and one of another
/// protocol.
void compare_with(BenchmarkReport& report, const std::string& other_json, const std::string& name);

}  // namespace boresight::app
