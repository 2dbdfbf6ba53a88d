#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::numerics {

unsigned thread_count(unsigned asked) {
  return asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
}

void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed = count;
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (i < failed) {
          failed = i;
          failure = std::current_exception();
        }
        next = count;
        return;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t helping = std::min<std::size_t>(std::max(threads, 1U), count);
    for (std::size_t t = 1; t < helping; ++t) workers.emplace_back(take_turns);
    take_turns();
  }
  if (failure) std::rethrow_exception(failure);
}

StepCounter::StepCounter(std::size_t all, Report report) : all_(all), report_(std::move(report)) {}

void StepCounter::step() {
  const std::lock_guard lock(mutex_);
  ++done_;
  if (report_) report_(done_, all_);
}

void StepCounter::expect(std::size_t more) {
  const std::lock_guard lock(mutex_);
  all_ += more;
}

}  // namespace boresight::numerics
