#pragma once

#include <functional>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

struct DesignedAntenna;

struct StudyOptions {
  std::uint64_t seed = 1;
  unsigned threads = 2;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

IdentificationSection identify(const io::Case& antenna, const StudyOptions& options);
PlantSection describe_plant(const io::Case& antenna);
/// The controller that study_controllers recommends, where none is fit the least unfit; its search
/// repeated from eight seeds, starting with options.seed; its structure tuned for other choices of
/// the plant; and matching at the case's flywheel counts and at ratio 1, of the case's structures
/// or of PI with and without lag, with the linear plant's friction and with the curve's slope at
/// the tracking rate. Fills the report's sections.
void redesign(const DesignedAntenna& designed, const StudyOptions& options, Report& report);

/// A few sentences that say what the numbers mean, from the numbers.
std::vector<std::string> conclude(const Report& report);

}  // namespace boresight::app
