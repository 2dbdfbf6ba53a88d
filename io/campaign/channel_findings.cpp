#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/records/suspect_channels.hpp>
#include <boresight/io/campaign/campaign_wording.hpp>
#include <boresight/io/campaign/channel_findings.hpp>

namespace boresight::io {
namespace {

using identification::ChannelCheck;
using identification::ChannelQuantity;

std::vector<std::string> compared_records(const CampaignSection& section, const ChannelCheck& one) {
  if (!one.record.empty()) return {one.record};
  const bool by_encoder = one.channel == ChannelCheck::Channel::tachometer;
  std::vector<std::string> names;
  for (const RecordNotes& record : section.notes.records) {
    const bool compared =
        !by_encoder ||
        std::ranges::find(record.sources, "encoder", &SignalSource::signal) != record.sources.end();
    if (compared && record.test != identification::TestKind::slosh) names.push_back(record.name);
  }
  return names;
}

std::string likely_text(const ChannelCheck& one) {
  if (!one.likely) return "";
  const std::string& name = one.likely->name;
  if (name.empty()) return fmt::format(", likely factor {:.3g}", one.likely->factor);
  const bool number = name.find_first_not_of("0123456789./") == std::string::npos;
  return fmt::format(", likely {}{}", number ? "factor " : "", name);
}

std::string_view what_to_do(const ChannelCheck& one) {
  if (!one.is_used) return "not used, the other motors' stand for it";
  if (identification::contradicts(one)) return "check the transducer or its scale in the case";
  if (one.quantity == ChannelQuantity::sign) {
    return "turn the encoder's sign (record_columns.reversed)";
  }
  return "no value depends on it";
}

}  // namespace

std::string departure_of(const ChannelCheck& check) {
  if (!check.interval) return "not determined";
  const auto& interval = *check.interval;
  if (identification::is_gain(check)) {
    return fmt::format("{} times ({} to {}) the {}, stated to {:.2g} %",
                       significant(interval.value), significant(interval.lower),
                       significant(interval.upper), check.against,
                       100.0 * check.stated_uncertainty / std::max(1.0, std::abs(interval.value)));
  }
  const ShownUnit unit = shown_unit(check.unit);
  return fmt::format(
      "{} {} ({} to {}) {} the {}, stated to {:.2g} {}",
      significant(std::abs(interval.value) * unit.scale), unit.name,
      significant((interval.value < 0.0 ? -interval.upper : interval.lower) * unit.scale),
      significant((interval.value < 0.0 ? -interval.lower : interval.upper) * unit.scale),
      check.quantity == ChannelQuantity::delay ? (interval.value < 0.0 ? "ahead of" : "behind")
                                               : (interval.value < 0.0 ? "below" : "above"),
      check.against, check.stated_uncertainty * unit.scale, unit.name);
}

bool channels_contradict(const CampaignSection& section) {
  return std::ranges::any_of(section.channels, identification::contradicts);
}

std::string channel_contradiction(const CampaignSection& section) {
  std::string text;
  for (const std::size_t place : identification::unexplained_suspects(section.channels)) {
    const ChannelCheck& one = section.channels[place];
    if (!identification::contradicts(one)) continue;
    text +=
        fmt::format("{}{}{} is {}", text.empty() ? "" : "; ", one.name,
                    one.record.empty() ? "" : " in record '" + one.record + "'", departure_of(one));
  }
  if (text.empty()) return text;
  return fmt::format(
      "The records' channels contradict one another: {}. Check the transducer or its scale in the "
      "case; the values below are of the channels as recorded.",
      text);
}

std::vector<ChannelSuspicion> channel_suspicions(const CampaignSection& section) {
  std::vector<ChannelSuspicion> found;
  std::vector<const ChannelCheck*> first;
  for (const std::size_t place : identification::unexplained_suspects(section.channels)) {
    const ChannelCheck& one = section.channels[place];
    const auto same = std::ranges::find_if(first, [&one](const ChannelCheck* other) {
      return identification::is_one_fault(*other, one);
    });
    if (same != first.end()) {
      found[static_cast<std::size_t>(same - first.begin())].channels.push_back(one.name);
      continue;
    }
    ChannelSuspicion suspicion;
    suspicion.finding = fmt::format("suspect {}", to_string(one.quantity));
    suspicion.records = compared_records(section, one);
    suspicion.channels = {one.name};
    suspicion.fraction = 1.0;
    suspicion.explanation =
        fmt::format("{}{}: {}", departure_of(one), likely_text(one), what_to_do(one));
    first.push_back(&one);
    found.push_back(std::move(suspicion));
  }
  return found;
}

}  // namespace boresight::io
