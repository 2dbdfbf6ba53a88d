#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/identify/record_traces.hpp>
#include <boresight/io/campaign/campaign.hpp>

namespace boresight::app {

/// One figure per record, including rejected ones: motor rate with its command, torque, valve
/// command, and every pressure channel that has a defect. Each kind of defect of a channel is
/// marked at its first occurrence. Values that replace masked samples are drawn over the record.
/// Section "Records".
/// `traces`: of each record of the notes (campaign_traces).
std::vector<Figure> record_figures(const io::CampaignNotes& notes,
                                   const std::vector<std::vector<RecordTrace>>& traces);

}  // namespace boresight::app
