#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/io/campaign/loaded_record.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

const identification::DriveRecord& find_record(const std::vector<io::LoadedRecord>& records,
                                               const std::string& name) {
  std::vector<std::string> known;
  for (const auto& one : records) {
    if (one.notes.name == name) {
      if (one.clean.record) return *one.clean.record;
      throw InvalidInput(
          fmt::format("commission: the record '{}' cannot be used: {}", name, one.clean.refusal));
    }
    known.push_back(one.notes.name);
  }
  throw InvalidInput(fmt::format("commission: expected a record of the case, {}, found '{}'",
                                 fmt::join(known, ", "), name));
}

}  // namespace

std::vector<ChannelComparison> compare_case_records(const io::Case& antenna,
                                                    const std::string& before,
                                                    const std::string& after, unsigned threads) {
  if (antenna.campaign.records.empty()) {
    throw InvalidInput(fmt::format(
        "{}: expected [[record]]s to compare, found none: name both records in the case",
        antenna.path));
  }
  if (before == after) {
    throw InvalidInput(
        fmt::format("commission: expected two records to compare, found '{}' twice", before));
  }
  const auto records = load_records(antenna, threads);
  const identification::DriveRecord& first = find_record(records, before);
  const identification::DriveRecord& second = find_record(records, after);
  io::CampaignNotes notes;
  const auto knowledge = drive_knowledge(antenna, notes);
  std::vector<ChannelComparison> result;
  for (auto& compared : design::compare_drive_records(first, second, knowledge)) {
    result.push_back({std::move(compared), std::nullopt});
  }
  return result;
}

}  // namespace boresight::app
