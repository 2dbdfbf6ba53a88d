#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include <boresight/app/commands/progress_line.hpp>

namespace boresight::app {

ProgressLine::ProgressLine(std::string work)
    : work_(std::move(work)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(std::size_t done, std::size_t all) {
  if (!terminal_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const double left = elapsed.count() * static_cast<double>(all - done) / static_cast<double>(done);
  fmt::print(stderr, "\r\033[K{}: {} of {}, about {:.0f} s left", work_, done, all, left);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace boresight::app
