#pragma once

#include <string>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// Name of a controller in sentences: "PI (robust)".
std::string name_and_purpose(const TunedController& row);

/// Reason why another controller of the same purpose and wind speed, not left_out, is not
/// recommended: "has 0.4375 mdeg rms instead of 0.4246".
std::string why_not_recommended(const TuneSection& section, const TunedController& other,
                                const TunedController& recommended);

/// Names the controllers whose figure is a tie with the recommended one's (design::tied_with), and
/// by what; empty without any.
std::string ties_text(const design::TuningStudy& study, const TunedController& recommended);

}  // namespace boresight::app
