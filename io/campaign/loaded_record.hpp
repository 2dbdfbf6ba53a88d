#pragma once

#include <vector>

#include <boresight/io/campaign/campaign.hpp>
#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// A record on its way from file to campaign.
struct LoadedRecord {
  RecordNotes notes;
  std::vector<RecordColumn> columns;  // without their values
  identification::RawRecord raw;
  identification::CleanRecord clean;
};

/// All records of a case, each by itself, at most `threads` at a time (0: as many as the machine
/// has). @throws InvalidInput as make_campaign.
std::vector<LoadedRecord> load_records(const Case& antenna, unsigned threads);

/// Recognises from the data the tests that the case does not name.
void recognise(const Case& antenna, std::vector<LoadedRecord>& works);

/// Leaves out, or cleans again, the channels named by identification::column_conflicts.
/// @throws InvalidInput if the campaign cannot be used.
void settle_conflicts(const Case& antenna, std::vector<LoadedRecord>& works);

}  // namespace boresight::io
