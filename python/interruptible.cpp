#include <atomic>
#include <chrono>
#include <future>

#include <pybind11/pybind11.h>

#include <boresight/python/interruptible.hpp>

namespace boresight::python {

namespace py = pybind11;

void run_interruptibly(const std::function<void(const StopRequest&)>& work) {
  using namespace std::chrono_literals;
  std::atomic<bool> stop = false;
  std::optional<py::error_already_set> signal;
  auto done = std::async(std::launch::async,
                         [&] { work([&stop] { return stop.load(std::memory_order_relaxed); }); });
  const auto finished = [&done] {
    const py::gil_scoped_release without_lock;
    return done.wait_for(50ms) == std::future_status::ready;
  };
  while (!finished()) {
    if (signal || PyErr_CheckSignals() == 0) continue;
    signal.emplace();
    stop = true;
  }
  if (signal) throw py::error_already_set(*signal);
  done.get();
}

}  // namespace boresight::python
