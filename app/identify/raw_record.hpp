#pragma once

#include <boresight/app/identify/campaign.hpp>
#include <boresight/io/records/record_table.hpp>

namespace boresight::app {

/// A recorder file's columns as signals at the motor shaft, SI, by the case's scales; the test and
/// the rate loop are left as they are. Sources, unused columns and remarks are added to the notes.
/// @throws InvalidInput for a column, unit or scale that is missing or of the wrong kind
identification::RawRecord raw_record(const io::Case& antenna, const io::RecordTable& table,
                                     RecordNotes& notes);

}  // namespace boresight::app
