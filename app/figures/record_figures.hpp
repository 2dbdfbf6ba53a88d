#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/identify/record_traces.hpp>
#include <boresight/io/campaign/campaign.hpp>

namespace boresight::app {

/// One figure a record, refused ones too: motor rate with its command, torque, valve command, and
/// every pressure that has a defect; each kind of defect of a channel is marked where it is first
/// seen, what stands in the place of masked samples is drawn over the record. Section "Records".
/// `traces`: of each record of the notes (campaign_traces).
std::vector<Figure> record_figures(const io::CampaignNotes& notes,
                                   const std::vector<std::vector<RecordTrace>>& traces);

}  // namespace boresight::app
