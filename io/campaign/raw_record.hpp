#pragma once

#include <boresight/io/campaign/campaign.hpp>
#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// A recorder file's columns as signals at the motor shaft, SI, by the case's scales; the test and
/// the rate loop are left as they are. Sources, unused columns and remarks are added to the notes.
/// @throws InvalidInput for a column, unit or scale that is missing or of the wrong kind
identification::RawRecord raw_record(const Case& antenna, const RecordTable& table,
                                     RecordNotes& notes);

}  // namespace boresight::io
