#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/campaign/compared_records.hpp>
#include <boresight/io/campaign/loaded_record.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

const identification::DriveRecord& find_record(const std::vector<LoadedRecord>& records,
                                               const std::string& name) {
  std::vector<std::string> known;
  for (const auto& one : records) {
    if (one.notes.name == name) {
      if (one.clean.record) return *one.clean.record;
      throw InvalidInput(
          fmt::format("the record '{}' cannot be used: {}", name, one.clean.refusal));
    }
    known.push_back(one.notes.name);
  }
  throw InvalidInput(
      fmt::format("expected a record of the case, {}, found '{}'", fmt::join(known, ", "), name));
}

}  // namespace

std::vector<design::QuantityComparison> compare_records_of(const Case& antenna,
                                                           const std::string& before,
                                                           const std::string& after,
                                                           unsigned threads) {
  if (antenna.campaign->records.empty()) {
    throw InvalidInput(fmt::format(
        "{}: expected [[record]]s to compare, found none: name both records in the case",
        antenna.path));
  }
  if (before == after) {
    throw InvalidInput(fmt::format("expected two records to compare, found '{}' twice", before));
  }
  const auto records = load_records(antenna, threads);
  const identification::DriveRecord& first = find_record(records, before);
  const identification::DriveRecord& second = find_record(records, after);
  CampaignNotes notes;
  const auto knowledge = drive_knowledge(antenna, notes);
  return design::compare_drive_records(first, second, knowledge);
}

}  // namespace boresight::io
