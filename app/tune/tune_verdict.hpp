#pragma once

#include <optional>
#include <string>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What a law is called in sentences: "PI (robust)".
std::string name_and_purpose(const TunedLaw& row);

/// The one controller that every conclusion of a study names: design::recommend at one wind speed,
/// or at that of best_law. Null where none is fit: then none is to be commissioned.
const TunedLaw* recommended_law(const TuneSection& section, std::optional<double> wind_speed = {});

/// The law that figures and exported models are of: the one recommended; where none is, that of the
/// time domain, and without one best_law. Null without a law.
const TunedLaw* shown_law(const TuneSection& section,
                          const std::optional<TimeDomainSection>& in_time);

/// Why a law of the same purpose and wind speed that is not left_out is not the one recommended,
/// as what it does: "hunts by +-0.4375 mdeg rather than +-0.4246".
std::string why_not_recommended(const TuneSection& section, const TunedLaw& other,
                                const TunedLaw& recommended);

}  // namespace boresight::app
