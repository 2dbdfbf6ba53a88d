#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/campaign/measured_record.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

bool begins_with_encoder(const std::string& name) {
  constexpr std::string_view word = "encoder";
  return name.size() >= word.size() &&
         std::equal(word.begin(), word.end(), name.begin(), [](char expected, char found) {
           return expected == found ||
                  (found >= 'A' && found <= 'Z' && found - 'A' + 'a' == expected);
         });
}

}  // namespace

const identification::DriveRecord& record_of_response(const identification::Campaign& campaign,
                                                      const CampaignNotes& notes,
                                                      const std::string& name) {
  std::vector<std::string> names;
  for (const auto& note : notes.records) {
    if (note.name == name && !note.refusal.empty()) {
      throw InvalidInput(fmt::format("the record was left out: {}", note.refusal));
    }
    names.push_back(note.name);
  }
  const auto found = std::ranges::find(campaign.records, name, &identification::DriveRecord::name);
  if (found == campaign.records.end()) {
    throw InvalidInput(
        fmt::format("expected a record of the case, one of {}", fmt::join(names, ", ")));
  }
  if (!found->valve_command || found->inlet_pressure.empty() || found->outlet_pressure.empty()) {
    throw InvalidInput(fmt::format(
        "expected a record with valve command and pressures, found none of {}: record them, or "
        "state their columns in [record_columns]",
        found->valve_command ? "the pressures" : "the valve command"));
  }
  if (found->rate_loop_closed) {
    throw InvalidInput(
        "expected a test with the rate loop open: closed, the valve command answers the noise "
        "that the response is to be freed of");
  }
  return *found;
}

std::optional<EncoderColumn> encoder_column(const Case& antenna, const RecordNotes& notes,
                                            Eigen::Index samples) {
  const RecordTable table = read_record(notes.path);
  const auto column = std::ranges::find_if(
      table.columns, [](const RecordColumn& one) { return begins_with_encoder(one.name); });
  if (column == table.columns.end()) return std::nullopt;
  EncoderColumn encoder{column->name, std::nullopt};
  const auto unit = recorded_unit(column->unit);
  const bool usable = unit && unit->dimension == dimension_of(Kind::angle);
  if (!usable || static_cast<Eigen::Index>(column->values.size()) != samples ||
      !std::ranges::all_of(column->values, [](double value) { return std::isfinite(value); })) {
    return encoder;
  }
  const bool turned =
      std::ranges::any_of(antenna.campaign->columns.reversed,
                          [&](const std::string& name) { return is_named(*column, name); });
  const double scale = unit->factor * gear_ratio(antenna) * (turned ? -1.0 : 1.0);
  encoder.motor_angle = scale * Eigen::Map<const Eigen::VectorXd>(column->values.data(), samples);
  return encoder;
}

}  // namespace boresight::io
