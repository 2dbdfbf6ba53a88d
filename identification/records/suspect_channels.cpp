#include <algorithm>

#include <boresight/identification/records/suspect_channels.hpp>

namespace boresight::identification {
namespace {

bool is_pressure(const ChannelCheck& check) {
  return check.channel == ChannelCheck::Channel::inlet ||
         check.channel == ChannelCheck::Channel::outlet;
}

bool explains(const ChannelCheck& other, const ChannelCheck& one) {
  if (other.verdict != ChannelVerdict::suspect || other.motor != one.motor) return false;
  if (!other.record.empty() && other.record != one.record) return false;
  if (one.channel == ChannelCheck::Channel::torque && is_pressure(other)) return true;
  return !is_gain(one) && is_gain(other) && other.channel == one.channel;
}

}  // namespace

bool is_gain(const ChannelCheck& check) {
  return check.quantity == ChannelQuantity::gain || check.quantity == ChannelQuantity::sign;
}

bool contradicts(const ChannelCheck& check) {
  return check.verdict == ChannelVerdict::suspect && check.is_used &&
         (check.channel != ChannelCheck::Channel::tachometer ||
          check.quantity == ChannelQuantity::gain);
}

std::vector<std::size_t> unexplained_suspects(const std::vector<ChannelCheck>& checks) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const ChannelCheck& one = checks[i];
    const bool explained = std::ranges::any_of(
        checks, [&one](const ChannelCheck& other) { return explains(other, one); });
    if (one.verdict == ChannelVerdict::suspect && !explained) places.push_back(i);
  }
  return places;
}

bool is_one_fault(const ChannelCheck& one, const ChannelCheck& other) {
  return one.motor == other.motor && one.quantity == other.quantity && one.record == other.record &&
         one.likely && other.likely && !one.likely->name.empty() &&
         one.likely->name == other.likely->name;
}

}  // namespace boresight::identification
