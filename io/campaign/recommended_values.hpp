#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/campaign/identified_case.hpp>

namespace boresight::io {

/// Why a campaign recommends no value.
enum class Rejection {
  none,
  channels_contradict,  // a channel is suspect against the others, see channel_findings.hpp
  contradicts_case,     // the fit contradicts stated numbers that inertia and stiffness rest on
  fit_failed,           // no model explains all records
};
Rejection rejection(const CampaignSection& section);
/// "channels contradict one another", "contradicts the case", "fit failed"; empty for none.
std::string to_string(Rejection why);

/// What a design may take from a campaign.
struct RecommendedValues {
  numerics::Interval inertia;              // kg m2, all of it at the motor shaft
  numerics::Interval motor_to_load_ratio;  // eq. 27
};
/// Values of the grey box; nothing if rejection() gives a reason. Neither a mean of methods nor a
/// fit that contradicts its own inputs is a basis for a design.
std::optional<RecommendedValues> recommended(const CampaignSection& section);

/// The stated number whose errors may change the inertia most before the records show them
/// (StatedNumberCheck::visible_error times inertia_effect); nothing where no value is recommended.
const identification::StatedNumberCheck* weakest_check(const CampaignSection& section);

/// What a redesign takes from the campaign instead of what the case states; nothing where no value
/// is recommended, or where what is recommended leaves the antenna no inertia.
std::vector<SupersededInput> superseded_inputs(const Case& stated, const CampaignSection& section);

/// Records and channels to check, for one reason.
struct ChannelSuspicion {
  /// As to_string(DefectKind); "suspect gain" and the like of a channel against others; "not
  /// explained" for a record that the fit misses.
  std::string finding;
  std::vector<std::string> records;
  std::vector<std::string> channels;  // as the files call them; empty: records as a whole
  /// Numbers of the case of which one is wrong, or the channels that measure with it are; the
  /// likeliest first.
  std::vector<std::string> stated_numbers;
  bool record_refused = false;
  double fraction = 0.0;    // of a record's samples, the largest
  std::string explanation;  // of the first
};

/// What is wrong with the data, the worst first: refused records; channels that are suspect against
/// others (channel_suspicions); channels that are dead,
/// exchanged, reversed or on another scale; samples that are missing, stuck or clipped, where they
/// are many (from a two-hundredth of a record; half for clipped ones, which fast tests mean to
/// have); and records, but slosh tests, whose rate the fit predicts five times worse than the
/// median record's. Where the fit contradicts the case, also the stated numbers that it contradicts
/// and the channels whose scale they are.
std::vector<ChannelSuspicion> suspicions(const CampaignSection& section);

}  // namespace boresight::io
