#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// What `boresight simulate` ran, in order; the tests' records without their channels, which are in
/// the files written.
struct SimulationReport {
  std::string case_path;
  std::string title;
  io::PointingAxis axis;
  std::uint64_t seed = 1;
  bool interrupted = false;
  /// What ended the work, and in which test; empty if nothing did.
  std::string failure;
  std::string failed_test;
  std::vector<std::string> not_run;  // names of tests
  std::vector<DriveTestSection> drive;
  std::vector<PositionTestSection> position;
  std::vector<std::string> written;  // paths of records
  std::vector<io::Quantity> assumed;
  std::vector<Figure> figures;
};

/// The report, and as text for a terminal.
Document document_of(const SimulationReport& report);
std::string to_text(const SimulationReport& report);

/// The members of the JSON report; docs/simulation.schema.json is made of it.
void describe(io::Visitor& v, const SimulationReport& report);
std::string to_json(const SimulationReport& report);

}  // namespace boresight::app
