#pragma once

#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// What the records of a campaign say: "campaign" of docs/report.schema.json. Numbers whose key
/// ends in _si are in the SI unit that `unit` names beside them (Hz for frequencies), since the
/// quantities have many.
void describe(Visitor& v, const CampaignSection& section);

/// Data of its plots: friction curve with points and band, torque spectra with peaks and harmonics,
/// ringing lines, rings after valve steps, torque over rate. To six digits.
void describe_campaign_plots(Visitor& v, const CampaignSection& section);

}  // namespace boresight::io
