#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

TEST(ForEachIndex, CallsEachOnceForAnyThreadCount) {
  for (const unsigned threads : {0u, 1u, 2u, 7u}) {
    std::vector<std::atomic<int>> calls(100);
    numerics::for_each_index(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
  numerics::for_each_index(0, 2, [](std::size_t) { FAIL() << "there is no index"; });
}

TEST(ForEachIndex, StopsAtTheFirstExceptionAndLetsItOut) {
  std::atomic<int> calls{0};
  const auto work = [&](std::size_t i) {
    ++calls;
    if (i == 3) throw std::runtime_error("three");
  };
  EXPECT_THROW(numerics::for_each_index(100000, 1, work), std::runtime_error);
  EXPECT_EQ(calls, 4);
  // How far another thread gets before it learns of that is chance.
  EXPECT_THROW(numerics::for_each_index(100000, 2, work), std::runtime_error);
}

TEST(ForEachIndex, LetsOutTheExceptionOfTheLowestIndex) {
  for (int trial = 0; trial < 20; ++trial) {
    std::atomic<bool> later{false};
    // The third waits until a later one has failed.
    const auto work = [&](std::size_t i) {
      if (i == 2) {
        while (!later) std::this_thread::yield();
        throw std::runtime_error("two");
      }
      if (i == 5) {
        later = true;
        throw std::runtime_error("five");
      }
    };
    EXPECT_THAT(reference::Call([&] { numerics::for_each_index(1000, 4, work); }),
                testing::ThrowsMessage<std::runtime_error>("two"));
  }
}

TEST(ThreadCount, IsWhatWasAskedForOrTheMachines) {
  EXPECT_EQ(numerics::thread_count(3), 3U);
  EXPECT_GE(numerics::thread_count(0), 1U);
}

TEST(StepCounter, ReportsEveryStepOnceWhicheverThreadTakesIt) {
  std::vector<std::size_t> done, all;
  numerics::StepCounter counter(100, [&](std::size_t so_far, std::size_t of) {
    done.push_back(so_far);
    all.push_back(of);
  });
  numerics::for_each_index(100, 4, [&](std::size_t i) {
    if (i == 50) counter.expect(1);
    counter.step();
  });
  counter.step();
  ASSERT_EQ(done.size(), 101U);
  for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], i + 1);
  EXPECT_EQ(all.front(), 100U);
  EXPECT_EQ(all.back(), 101U);
  EXPECT_NO_THROW(numerics::StepCounter(1, nullptr).step());
}

}  // namespace
}  // namespace boresight::design
