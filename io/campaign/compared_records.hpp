#pragma once

#include <string>
#include <vector>

#include <boresight/design/commissioning/drive_record_comparison.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// Two records of a case, made before and after a change of the controller, by the quantities that
/// both have (design::compare_drive_records). `threads`: records read at a time, as make_campaign.
/// @throws InvalidInput for a case without records, a name that no usable record has or that is
/// given twice, as make_campaign and design::compare_drive_records.
std::vector<design::QuantityComparison> compare_records_of(const Case& antenna,
                                                           const std::string& before,
                                                           const std::string& after,
                                                           unsigned threads);

}  // namespace boresight::io
