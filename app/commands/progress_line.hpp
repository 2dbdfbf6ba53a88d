#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace boresight::app {

/// "90 s", "12 min", "3.5 h": as exact as a forecast is.
std::string duration_text(double seconds);

/// One line on standard error with progress and estimated remaining time. Silent if standard error
/// is no terminal or quiet() is set.
class ProgressLine {
 public:
  /// What is being worked on, as the line begins.
  explicit ProgressLine(std::string work);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;
  void show(std::size_t done, std::size_t all);

 private:
  std::string work_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace boresight::app
