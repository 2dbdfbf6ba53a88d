#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

namespace boresight::python {

/// Asked from any thread: whether the work should end.
using StopRequest = std::function<bool()>;

/// Runs work on a thread of its own, without the interpreter's lock, while this thread looks after
/// signals. After Ctrl-C the work is asked to stop, and Python's exception (KeyboardInterrupt)
/// comes out of here once it has. What the work throws comes out as it is. Takes the lock to be
/// held.
void run_interruptibly(const std::function<void(const StopRequest&)>& work);

/// The same of work that returns something.
template <typename Work>
auto interruptible(const Work& work) {
  std::optional<std::invoke_result_t<const Work&, const StopRequest&>> result;
  run_interruptibly([&](const StopRequest& stop) { result.emplace(work(stop)); });
  return std::move(result).value();  // NOLINT(bugprone-unchecked-optional-access): else it threw
}

}  // namespace boresight::python
