#include <utility>

#include <fmt/format.h>

#include <boresight/app/change/change_report.hpp>
#include <boresight/app/figures/change_figures.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {
namespace {

RecordedController recorded(const ChosenController& chosen, const io::GainUnits& units) {
  RecordedController result{chosen.structure, chosen.source, {}, {}};
  const auto& structure = chosen.controller.structure;
  if (structure.state_space() != nullptr) {
    result.state_space = state_space_text(structure);
    return result;
  }
  const auto texts = units.texts(chosen.controller);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto& description = structure.gains()[i];
    result.gains.push_back(
        {std::string(description.symbol), std::string(description.name), texts[i]});
  }
  return result;
}

std::vector<identification::ServoRecord> records_of(const std::vector<ReadServoRecord>& files) {
  std::vector<identification::ServoRecord> records;
  for (const auto& file : files) records.push_back(file.record);
  return records;
}

std::vector<io::ServoRecordNotes> notes_of(const std::vector<ReadServoRecord>& files) {
  std::vector<io::ServoRecordNotes> notes;
  for (const auto& file : files) notes.push_back(file.notes);
  return notes;
}

}  // namespace

ChangeReport report_change(const io::DesignedAntenna& designed,
                           const std::vector<ReadServoRecord>& before,
                           const std::vector<ReadServoRecord>& after,
                           const std::optional<ChosenController>& old_controller,
                           const ChosenController& new_controller, std::uint64_t seed,
                           const design::ChangeOptions& options) {
  const io::Case& antenna = designed.antenna;
  const auto& mast = antenna.wind->mast;
  const double speed_ratio = mast ? mast->speed_ratio : 1.0;
  ChangeReport report;
  static_cast<design::ChangeStudy&>(report) = design::study_change(
      designed.mission, designed.ensemble,
      design::change_records(records_of(before), records_of(after), speed_ratio),
      old_controller ? std::optional(old_controller->controller) : std::nullopt,
      new_controller.controller, options);
  report.case_path = antenna.path;
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.seed = seed;
  report.confidence = options.confidence;
  const io::GainUnits units(antenna);
  if (old_controller) report.old_controller = recorded(*old_controller, units);
  report.new_controller = recorded(new_controller, units);
  report.ensemble_source = to_string(designed.ensemble.source);
  report.before_files = notes_of(before);
  report.after_files = notes_of(after);
  if (speed_ratio != 1.0) {
    report.remarks.push_back(fmt::format(
        "Wind speeds are those of the records times {:.4g}: at the dish's centre, not at the mast.",
        speed_ratio));
  }
  report.assumed = assumed_inputs(antenna, {});
  report.figures = change_figures(report);
  return report;
}

}  // namespace boresight::app
