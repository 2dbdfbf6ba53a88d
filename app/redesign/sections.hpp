#pragma once

#include <functional>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

struct StudyOptions {
  std::uint64_t seed = 1;
  unsigned threads = 2;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

IdentificationSection identify(const io::Case& antenna, const StudyOptions& options);
PlantSection describe_plant(const io::Case& antenna);
/// Tuning from eight seeds, starting with options.seed, choices, and matching at the case's
/// flywheel counts and at ratio 1, with and without lag, with the linear plant's friction and with
/// the curve's slope at the tracking rate: in one pool of work. Fills the report's sections.
void redesign(const io::Case& antenna, const StudyOptions& options, Report& report);

/// A few sentences that say what the numbers mean, from the numbers.
std::vector<std::string> conclude(const Report& report);

}  // namespace boresight::app
