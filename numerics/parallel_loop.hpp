#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace boresight::numerics {

/// `asked` threads, or as many as the machine has where that is 0.
unsigned thread_count(unsigned asked);

/// Calls `work` once for each index below `count`, on up to `threads` threads (at least one, this
/// one included), indices taken as they rise. An exception stops the loop and comes out of here: of
/// several that of the lowest index, so that it is the same for any number of threads.
void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work);

/// Counts the steps of a job distributed over several threads and reports each, one call at a time.
class StepCounter {
 public:
  using Report = std::function<void(std::size_t done, std::size_t all)>;

  /// Without a report it only counts.
  StepCounter(std::size_t all, Report report);

  /// One more step is done.
  void step();

  /// The job turns out to have more steps.
  void expect(std::size_t more);

 private:
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t all_;
  Report report_;
};

}  // namespace boresight::numerics
