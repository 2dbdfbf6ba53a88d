#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/design/studies/change_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/records/servo_record_file.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// A gain as a change record lists it.
struct RecordedGain {
  std::string symbol, name;
  std::string text;  // with its unit
};

/// A controller of a change record.
struct RecordedController {
  std::string structure, source;
  std::vector<RecordedGain> gains;  // none of a state space
  std::string state_space;          // in words; empty for gains
};

/// How one file was read.
struct ReadServoRecord {
  identification::ServoRecord record;
  io::ServoRecordNotes notes;
};

/// What `boresight benchmark --before --after` reports.
struct ChangeReport : design::ChangeStudy {
  std::string case_path, title;
  io::PointingAxis axis;
  std::uint64_t seed = 1;
  double confidence = 0.95;
  std::optional<RecordedController> old_controller;
  RecordedController new_controller;
  std::string ensemble_source;
  std::vector<io::ServoRecordNotes> before_files, after_files;
  std::vector<std::string> remarks;
  std::vector<io::Quantity> assumed;
  std::vector<Figure> figures;
};

/// design::study_change of the antenna and the files read, in words.
/// @throws as design::change_records and design::study_change.
ChangeReport report_change(const io::DesignedAntenna& designed,
                           const std::vector<ReadServoRecord>& before,
                           const std::vector<ReadServoRecord>& after,
                           const std::optional<ChosenController>& old_controller,
                           const ChosenController& new_controller, std::uint64_t seed,
                           const design::ChangeOptions& options);

/// The decision in one or two sentences: "Position error rms after the change is 0.52 ...".
std::vector<std::string> decision(const ChangeReport& report);

/// The sections that a report and a change record have in common.
Document controllers_part(const ChangeReport& report);
Document evidence_part(const ChangeReport& report);
Document checks_part(const ChangeReport& report);

/// The report, and as text for a terminal.
Document document_of(const ChangeReport& report);
std::string to_text(const ChangeReport& report);
/// The members of the JSON report, from which docs/change.schema.json is generated.
void describe(io::Visitor& v, const ChangeReport& report);
std::string to_json(const ChangeReport& report);

/// One page of HTML to print, sign and file: decision, old and new gains, evidence, checks, and
/// lines for initials and date. Without scripts and other files.
std::string change_record(const ChangeReport& report);

}  // namespace boresight::app
