#pragma once

#include <string>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What a law is called in sentences: "PI (robust)".
std::string name_and_purpose(const TunedLaw& row);

/// Why a law of the same purpose and wind speed that is not left_out is not the one recommended,
/// as what it does: "hunts by +-0.4375 mdeg rather than +-0.4246".
std::string why_not_recommended(const TuneSection& section, const TunedLaw& other,
                                const TunedLaw& recommended);

/// Names the controllers whose figure is a tie with the recommended one's (design::tied_with), and
/// by what; empty without any.
std::string ties_text(const design::TuningStudy& study, const TunedLaw& recommended);

}  // namespace boresight::app
