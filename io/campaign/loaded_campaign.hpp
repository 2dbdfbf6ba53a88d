#pragma once

#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/io/campaign/loaded_record.hpp>

namespace boresight::io {

/// The records of a case as recorded and as cleaned, and what is known of its drive: what plots of
/// the records and their identification both start from, so that each file is read once.
struct LoadedCampaign {
  std::vector<LoadedRecord> records;  // in the case's order, refused ones too
  identification::DriveKnowledge knowledge;
  identification::Instruments instruments;  // as stated
  /// What was taken for granted of the drive and the instruments, a sentence each.
  std::vector<std::string> assumptions;
};

/// Reads and cleans all records of a case, recognises the tests that it does not name, and resolves
/// conflicts between the records and its columns. `threads`: records read at a time; 0: as many as
/// the machine has. The result does not depend on it.
/// @throws InvalidInput as make_campaign, except if most records are refused.
LoadedCampaign load_campaign(const Case& antenna, unsigned threads);

/// The records of use and the instruments' uncertainties with dead pressures replaced, as the
/// make_campaign of a case alone. `loaded`: of the same case; given away, its raw samples are
/// freed. `notes`: written anew.
/// @throws InvalidInput if most records are refused.
identification::Campaign make_campaign(const Case& antenna, LoadedCampaign loaded,
                                       CampaignNotes& notes);

}  // namespace boresight::io
