#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/campaign/campaign_wording.hpp>

namespace boresight::app {

Document document_of(const std::vector<identification::ChannelCheck>& channels) {
  if (channels.empty()) return {};
  Document text = heading("Channels against one another");
  std::vector<std::vector<std::string>> rows{
      {"channel", "record", "quantity", "value", "95 % interval", "1 sigma", "against", "verdict"}};
  for (const auto& one : channels) {
    const auto unit = io::shown_unit(one.unit);
    std::string verdict = to_string(one.verdict);
    if (one.likely) {
      verdict += ", " + (one.likely->name.empty() ? fmt::format("{:.3g}", one.likely->factor)
                                                  : one.likely->name);
    }
    // "inlets of the other motors" is too long for a column.
    constexpr std::string_view others = " of the other motors";
    std::string against = one.against;
    if (against.ends_with(others)) {
      against = "other " + against.substr(0, against.size() - others.size());
    }
    rows.push_back({one.name, one.record.empty() ? "all" : one.record,
                    unit.name == "1" ? to_string(one.quantity)
                                     : fmt::format("{}, {}", to_string(one.quantity), unit.name),
                    one.interval ? io::significant(unit.scale * one.interval->value) : "-",
                    one.interval ? io::range(*one.interval, unit.scale) : "-",
                    fmt::format("{:.2g}", unit.scale * one.stated_uncertainty), against, verdict});
  }
  text += table(rows, "lllrrrll");
  return text + wrapped(
                    "Value: what the channel's gain (1 if right), zero and delay must be for what "
                    "it is compared with to be right; 1 sigma by the stated accuracy of both. "
                    "Suspect: more than 3.5 standard uncertainties of both together from 1 or 0.",
                    "  ");
}

}  // namespace boresight::app
