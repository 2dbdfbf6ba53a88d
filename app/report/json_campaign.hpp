#pragma once

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/identify/campaign_section.hpp>

namespace boresight::app {

/// What the records of a campaign say, as a JSON object. Numbers whose key ends in _si are in the
/// SI unit that `unit` names beside them (Hz for frequencies), since the quantities have many.
nlohmann::ordered_json campaign_json(const CampaignSection& section);

/// Data of its plots: friction curve with points and band, torque spectra with peaks and harmonics,
/// ringing lines, rings after valve steps, torque over rate. To six digits.
nlohmann::ordered_json campaign_plots_json(const CampaignSection& section);

/// {unit, value_si, standard_uncertainty_si, lower_95_si, upper_95_si}
nlohmann::ordered_json interval_json(const numerics::Interval& interval, const std::string& unit);

}  // namespace boresight::app
