#include <mutex>
#include <optional>
#include <utility>

#include <boresight/design/simulation/test_runs.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// What became of a run.
struct RunState {
  std::optional<TestRecord> record;
  std::exception_ptr failure;
  double done = 0.0;  // fraction
  bool begun = false;
  bool over = false;
};

class TestRuns {
 public:
  TestRuns(const std::vector<TestRun>& runs, const TestRunCalls& calls)
      : runs_(runs), calls_(calls), states_(runs.size()) {}

  void make(std::size_t i) {
    {
      const std::lock_guard lock(mutex_);
      if (failure_ || calls_.interrupted()) return;
      states_[i].begun = true;
    }
    std::optional<TestRecord> record;
    std::exception_ptr failure;
    try {
      record = runs_[i]([this, i](double done) { return goes_on(i, done); });
    } catch (const std::exception&) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    states_[i].record = std::move(record);
    states_[i].failure = failure;
    states_[i].over = true;
    while (kept_ < runs_.size() && states_[kept_].over && !failure_) keep_next();
  }

  TestRunsOutcome outcome() const {
    TestRunsOutcome outcome{kept_, {}, failure_};
    for (const auto& state : states_) outcome.begun.push_back(state.begun);
    return outcome;
  }

 private:
  // A run ends early on request, and where one before it failed.
  bool goes_on(std::size_t i, double done) {
    const std::lock_guard lock(mutex_);
    states_[i].done = done;
    double sum = 0.0;
    for (const auto& state : states_) sum += state.over ? 1.0 : state.done;
    calls_.progress(sum / static_cast<double>(states_.size()));
    return !failure_ && !calls_.interrupted();
  }

  void keep_next() {
    RunState& state = states_[kept_];
    if (!state.failure && state.record) {
      try {
        calls_.keep(kept_, std::move(*state.record));
        state.record.reset();
        ++kept_;
        return;
      } catch (const std::exception&) {
        state.failure = std::current_exception();
      }
    }
    failure_ = state.failure;
  }

  const std::vector<TestRun>& runs_;
  const TestRunCalls& calls_;
  std::mutex mutex_;  // of all below
  std::vector<RunState> states_;
  std::size_t kept_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

TestRunsOutcome run_tests(const std::vector<TestRun>& runs, unsigned threads,
                          const TestRunCalls& calls) {
  TestRuns all(runs, calls);
  // What the calls throw outside a run is the failure of nobody's test.
  numerics::for_each_index(runs.size(), threads, [&](std::size_t i) { all.make(i); });
  return all.outcome();
}

}  // namespace boresight::design
