#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/design/parallel_loop.hpp>

namespace boresight::design {
namespace {

TEST(ForEachIndex, CallsEachOnceForAnyThreadCount) {
  for (const unsigned threads : {0u, 1u, 2u, 7u}) {
    std::vector<std::atomic<int>> calls(100);
    for_each_index(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
  for_each_index(0, 2, [](std::size_t) { FAIL() << "there is no index"; });
}

TEST(ForEachIndex, StopsAtTheFirstExceptionAndLetsItOut) {
  std::atomic<int> calls{0};
  const auto work = [&](std::size_t i) {
    ++calls;
    if (i == 3) throw std::runtime_error("three");
  };
  EXPECT_THROW(for_each_index(100000, 2, work), std::runtime_error);
  EXPECT_LT(calls, 100000);
}

}  // namespace
}  // namespace boresight::design
