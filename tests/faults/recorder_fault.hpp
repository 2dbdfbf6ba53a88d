#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../random_numbers.hpp"
#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/records/record_defects.hpp>

namespace boresight::faults {

/// What identify is given: the recorder's columns, the numbers of the drawings and the instruments'
/// stated accuracy.
struct RecordedCampaign {
  std::vector<identification::RawRecord> records;
  identification::DriveKnowledge knowledge;
  identification::Instruments instruments;
};

/// One way in which recorders, transducers and those who describe them fail.
struct RecorderFault {
  std::string kind;  // "gain", "missing samples"; rows of the table stand together by it
  std::string name;  // unique: "tachometer x 1.05"
  /// Beginnings of the names of the columns, records or stated numbers that a report has to name;
  /// empty: nothing is wrong that anybody could name.
  std::vector<std::string> names;
  /// Changes the campaign; the numbers are the campaign's and fault's own.
  std::function<void(RecordedCampaign&, reference::RandomNumbers&)> apply;
  /// Why only other stated numbers contradict it, where no channel does; else empty.
  std::string why_hidden = {};
  /// The stated number that it puts in error (StatedNumberCheck::name), and by how much: stated
  /// over true, less 1.
  std::string stated_number = {};
  double stated_error = 0.0;
};

/// All of them, none applied first for comparison.
std::vector<RecorderFault> recorder_faults();

/// Those whose kind or name begins with one of the words; all without words.
/// @throws InvalidInput for a word that none begins with.
std::vector<RecorderFault> recorder_faults(const std::vector<std::string>& words);

}  // namespace boresight::faults
