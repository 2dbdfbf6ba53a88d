#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

std::string duration_text(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds < 2.0 * minute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2.0 * hour) return fmt::format("{:.0f} min", seconds / minute);
  return fmt::format("{:.1f} h", seconds / hour);
}

ProgressLine::ProgressLine(std::string work)
    : work_(std::move(work)),
      terminal_(isatty(STDERR_FILENO) != 0 && !quiet()),
      start_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(std::size_t done, std::size_t all) {
  if (!terminal_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const double left = elapsed.count() * static_cast<double>(all - done) / static_cast<double>(done);
  fmt::print(stderr, "\r\033[K{}: {} of {}{}", work_, done, all,
             done == 0 ? "" : fmt::format(", about {} left", duration_text(left)));
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace boresight::app
