#pragma once

#include <boresight/app/report/report.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>

namespace boresight::app {

using StudyOptions = io::IdentificationOptions;

IdentificationSection identify(const io::Case& antenna, const StudyOptions& options);
PlantSection describe_plant(const io::Case& antenna);
/// The controller that study_controllers recommends, where none is fit the least unfit; its search
/// repeated from eight seeds, starting with options.seed; its structure tuned for other choices of
/// the plant; and matching at the case's flywheel counts and at ratio 1, of the case's structures
/// or of PI with and without lag, with the linear plant's friction and with the curve's slope at
/// the tracking rate. Fills the report's sections.
void redesign(const io::DesignedAntenna& designed, const StudyOptions& options, Report& report);

/// A few sentences that say what the numbers mean, from the numbers.
std::vector<std::string> conclude(const Report& report);

}  // namespace boresight::app
