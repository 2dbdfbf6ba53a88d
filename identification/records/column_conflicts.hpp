#pragma once

#include <string>
#include <vector>

#include <boresight/identification/records/record_defects.hpp>

namespace boresight::identification {

/// A record with what cleaning it has shown.
struct EvaluatedRecord {
  const RawRecord* raw = nullptr;
  const CleanRecord* clean = nullptr;
};

/// What to do with one record for its columns' names and signs.
struct RecordConflict {
  /// For clean_record, to do the record again with.
  DefectOptions options;
  bool again = false;
  /// Why the record cannot be used, a sentence; empty if it can.
  std::string refusal;
};

/// What a campaign's columns are as a whole.
struct ColumnConflicts {
  /// Why the campaign cannot be used until somebody sets its columns right: which column, in which
  /// records, and the remedy. Empty if it can.
  std::string refusal;
  std::vector<RecordConflict> records;  // one a record
};

/// Combines the suspicions of all records. A column is what it is in the whole campaign:
/// what half or more of the records in motion (slosh tests aside) show holds for all of them, what
/// fewer show for those alone.
///
/// A motor whose pressure difference goes against the others' has its ports exchanged, and counts
/// with neither; where that is half of the motors or more, nobody can tell which, and campaign or
/// record are refused. So they are where the torque works against the motion: the tachometer's sign
/// is turned, or all inlets and outlets are exchanged. A command against the tachometer alone is
/// left out.
ColumnConflicts column_conflicts(const std::vector<EvaluatedRecord>& records);

}  // namespace boresight::identification
