#include <chrono>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/simulation/test_runs.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;

TestRecord named(const std::string& test) {
  DriveTestRecord record;
  record.test = test;
  return record;
}

TestRun run_of(const std::string& test) {
  return [test](const RunProgress&) { return named(test); };
}

TestRun failing() {
  return [](const RunProgress&) -> TestRecord { throw NumericalFailure("it fell"); };
}

// What was kept, in order.
struct Kept {
  std::vector<std::string> tests;
  TestRunCalls calls() {
    return {[] { return false; }, [](double) {},
            [this](std::size_t run, const TestRecord& record) {
              EXPECT_EQ(run, tests.size());
              tests.push_back(std::get<DriveTestRecord>(record).test);
            }};
  }
};

TEST(TestRuns, KeepRecordsInTheOrderOfTheRuns) {
  std::vector<TestRun> runs;
  for (int i = 0; i < 4; ++i) {
    runs.emplace_back([i](const RunProgress&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5 * (3 - i)));
      return named(std::to_string(i));
    });
  }
  for (const unsigned threads : {1U, 4U}) {
    Kept kept;
    const auto outcome = run_tests(runs, threads, kept.calls());
    EXPECT_THAT(kept.tests, ElementsAre("0", "1", "2", "3"));
    EXPECT_EQ(outcome.kept, 4U);
    EXPECT_THAT(outcome.begun, ElementsAre(true, true, true, true));
    EXPECT_FALSE(outcome.failure);
  }
}

TEST(TestRuns, EndWithTheFirstFailure) {
  const std::vector<TestRun> runs{run_of("a"), failing(), run_of("c"), failing()};
  for (const unsigned threads : {1U, 3U}) {
    Kept kept;
    const auto outcome = run_tests(runs, threads, kept.calls());
    EXPECT_THAT(kept.tests, ElementsAre("a"));
    EXPECT_EQ(outcome.kept, 1U);
    ASSERT_TRUE(outcome.failure);
    EXPECT_THROW(std::rethrow_exception(outcome.failure), NumericalFailure);
    if (threads == 1) {
      EXPECT_THAT(outcome.begun, ElementsAre(true, true, false, false));
    }
  }
}

TEST(TestRuns, AFailureToKeepIsThatOfTheRun) {
  Kept kept;
  auto calls = kept.calls();
  const auto keep = calls.keep;
  calls.keep = [&](std::size_t run, TestRecord record) {
    if (run == 1) throw InvalidInput("no room");
    keep(run, std::move(record));
  };
  const auto outcome = run_tests({run_of("a"), run_of("b"), run_of("c")}, 1, calls);
  EXPECT_THAT(kept.tests, ElementsAre("a"));
  EXPECT_EQ(outcome.kept, 1U);
  ASSERT_TRUE(outcome.failure);
  EXPECT_THROW(std::rethrow_exception(outcome.failure), InvalidInput);
}

TEST(TestRuns, KeepWhatIsUnderWayWhenInterrupted) {
  Kept kept;
  auto calls = kept.calls();
  bool interrupted = false;
  std::vector<double> fractions;
  calls.interrupted = [&] { return interrupted; };
  calls.progress = [&](double fraction) { fractions.push_back(fraction); };
  const TestRun half = [&](const RunProgress& progress) {
    EXPECT_TRUE(progress(0.25));
    interrupted = true;
    EXPECT_FALSE(progress(0.5));
    return named("half");
  };
  const auto outcome = run_tests({half, run_of("b")}, 1, calls);
  EXPECT_THAT(kept.tests, ElementsAre("half"));
  EXPECT_EQ(outcome.kept, 1U);
  EXPECT_THAT(outcome.begun, ElementsAre(true, false));
  EXPECT_FALSE(outcome.failure);
  EXPECT_THAT(fractions, ElementsAre(0.125, 0.25));  // of both runs
}

}  // namespace
}  // namespace boresight::design
