#pragma once

#include <string>
#include <vector>

#include <boresight/app/commission/commission_study.hpp>

namespace boresight::app {

/// The stages of the report's plan as an engineer reads them. `study`: their steps and
/// experiments.
std::vector<StageSheet> make_sheets(const io::Case& antenna, const CommissionReport& report,
                                    const design::CommissionStudy& study);

/// A few sentences that say what plan and comparisons mean.
std::vector<std::string> conclude(const CommissionReport& report, const io::Case& antenna);

}  // namespace boresight::app
