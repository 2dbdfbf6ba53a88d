#pragma once

#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/records/record_defects.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/records/signal_source.hpp>

namespace boresight::io {

/// What became of one recorder file.
struct RecordNotes {
  std::string name;
  std::string path;
  std::string description;
  std::string format;
  std::size_t bytes = 0;
  std::string sha256;        // of the file's bytes, hexadecimal
  std::size_t rows = 0;      // samples of the file
  double sample_time = 0.0;  // s, of the record as used
  double duration = 0.0;     // s
  identification::TestKind test = identification::TestKind::other;
  bool test_guessed = false;
  bool rate_loop_closed = false;
  bool rate_loop_guessed = false;
  std::vector<SignalSource> sources;
  std::vector<std::string> unused_columns;
  /// Of the reader: lines left out and the like.
  std::vector<std::string> remarks;
  std::vector<identification::RecordDefect> defects;
  /// Why the record is not in the campaign; empty if it is.
  std::string refusal;
};

/// Everything that was found or guessed on the way from files to a campaign, for the report.
struct CampaignNotes {
  std::vector<RecordNotes> records;  // in the case's order, refused ones too
  /// What was taken for granted of the drive and the instruments, a sentence each.
  std::vector<std::string> assumptions;
};

/// Reads all records of a case and what is known of its drive. Record files stand relative to the
/// case's folder. Defects of the data are handled as identification::clean_record says; a record
/// that it refuses is left out and noted.
///
/// A motor whose pressure transducer is dead has the mean of the others' at the same common line
/// instead: the instruments' standard uncertainties are raised to what the sum over the motors then
/// has, and the assumption is noted.
/// Columns that most records contradict in name or sign are handled as
/// identification::column_conflicts says.
/// `threads`: records read at a time; 0: as many as the machine has. The result is the same.
/// @throws InvalidInput if the case has no records or no instruments, for a file that cannot be
/// read, a column, unit or scale that is missing or of the wrong kind, for columns whose names or
/// signs the records contradict beyond repair, and if most records are
/// refused.
identification::Campaign make_campaign(const Case& antenna, CampaignNotes& notes,
                                       unsigned threads = 0);

/// The part of it that needs no files. Assumptions are added to the notes.
identification::DriveKnowledge drive_knowledge(const Case& antenna, CampaignNotes& notes);

/// "slosh", "fast-ramp" and so on, as in a case.
std::string to_string(identification::TestKind test);

}  // namespace boresight::io
