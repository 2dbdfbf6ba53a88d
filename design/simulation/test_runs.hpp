#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include <boresight/design/simulation/drive_run.hpp>
#include <boresight/design/simulation/position_run.hpp>

namespace boresight::design {

using TestRecord = std::variant<DriveTestRecord, PositionTestRecord>;

/// Makes one record, calling `progress` as it runs.
using TestRun = std::function<TestRecord(const RunProgress& progress)>;

/// Callbacks of the runs, called one at a time. All must be given.
struct TestRunCalls {
  /// Returns whether to end: records under way are then kept up to that time, the rest is skipped.
  std::function<bool()> interrupted;
  std::function<void(double fraction)> progress;  // fraction of all runs, 0..1
  /// Receives the records in the order of their runs, each as soon as all before it were received.
  /// An exception from it counts as the failure of that run.
  std::function<void(std::size_t run, TestRecord record)> keep;
};

struct TestRunsOutcome {
  std::size_t kept = 0;        // number of first runs whose records were kept
  std::vector<bool> begun;     // one per run
  std::exception_ptr failure;  // of run number `kept`; null: none failed
};

/// Makes the records of several runs, as many at a time as there are threads. The first failure, in
/// the order of the runs, ends all. The records before it are kept and those after it are
/// discarded, as in sequential runs.
TestRunsOutcome run_tests(const std::vector<TestRun>& runs, unsigned threads,
                          const TestRunCalls& calls);

}  // namespace boresight::design
