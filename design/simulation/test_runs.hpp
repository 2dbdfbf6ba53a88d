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

/// One record to make, asking `progress` as it goes.
using TestRun = std::function<TestRecord(const RunProgress& progress)>;

/// Whom the runs ask and tell, one call at a time. All must be given.
struct TestRunCalls {
  /// Whether to end: records under way are then kept up to there, the rest is left out.
  std::function<bool()> interrupted;
  std::function<void(double share)> progress;  // of all runs, 0..1
  /// Takes the records in the order of their runs, each as soon as all before it were taken. What
  /// it throws is the failure of that run.
  std::function<void(std::size_t run, TestRecord record)> keep;
};

struct TestRunsOutcome {
  std::size_t kept = 0;        // so many of the first runs gave records that were taken
  std::vector<bool> begun;     // one a run
  std::exception_ptr failure;  // of run number `kept`; null: none failed
};

/// Makes the records of several runs, so many at a time as there are threads. The first failure, in
/// the order of the runs, ends all: the records before it are kept all the same, and those behind
/// it are left out, as if run one by one.
TestRunsOutcome run_tests(const std::vector<TestRun>& runs, unsigned threads,
                          const TestRunCalls& calls);

}  // namespace boresight::design
