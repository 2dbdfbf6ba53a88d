#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/tune/measured_section.hpp>
#include <boresight/io/campaign/measured_record.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

const identification::DriveRecord& record_named(const identification::Campaign& campaign,
                                                const io::CampaignNotes& notes,
                                                const std::string& name) {
  try {
    return record_of_response(campaign, notes, name);
  } catch (const InvalidInput& refusal) {
    throw InvalidInput(fmt::format("--measured {}: {}", io::in_quotes(name), refusal.what()));
  }
}

std::string unused_column(const std::string& name, Eigen::Index samples) {
  return fmt::format(
      "column {} is not used: it needs an angle's unit and a number in each of the record's {} "
      "samples",
      io::in_quotes(name), samples);
}

void add_notes(MeasuredTuneSection& section) {
  auto& notes = section.notes;
  if (!section.oil_failure.empty()) {
    notes.push_back(
        fmt::format("the record does not give the oil spring: {}", section.oil_failure));
  }
  notes.emplace_back(
      "the rms is the encoder's, with wind as a torque at the motor shaft: drive tests do not show "
      "flexure beyond the encoder or between wind and shaft");
  notes.push_back(
      fmt::format("below the hydraulic resonance the response to wind is that of a model oil "
                  "spring, {:.4g} N m/rad with a loss rate of {:.4g} 1/s, {}",
                  section.oil.stiffness, section.oil.loss_rate, section.oil_source));
  notes.push_back(
      fmt::format("results hold for small motion about the record's {:.3g} rad/s of motor: "
                  "friction and orifices differ at tracking speed",
                  section.mean_rate));
  if (!section.encoder_recorded) {
    notes.emplace_back(
        "no encoder was recorded: its difference from the motor angle is that of the case's "
        "structure, uncertain by 20 %, and the position loop depends on it");
  }
  notes.push_back(fmt::format(
      "constraints applied: maximum sensitivity Ms and control effort; not applied: Ms at "
      "standstill{}",
      section.other_goals ? ", margins, bandwidth, gust demand, static error" : ""));
}

}  // namespace

MeasuredTuneSection tune_measured(const io::Case& antenna, const MeasuredTuneOptions& options) {
  std::vector<std::string> names = options.structures;
  if (names.empty()) names = {"PI", "DPF"};
  std::vector<design::NamedStructure> structures;
  for (const auto& name : names) structures.push_back({name, io::loop_structure(antenna, name)});

  io::CampaignNotes read;
  const identification::Campaign campaign = make_campaign(antenna, read);
  const identification::DriveRecord& record = record_named(campaign, read, options.record);
  const auto note = std::ranges::find(read.records, options.record, &io::RecordNotes::name);
  const auto column = encoder_column(antenna, *note, record.samples());
  const std::optional<Eigen::VectorXd> encoder = column ? column->motor_angle : std::nullopt;

  design::MeasuredTuningOptions tuning;
  tuning.seed = options.seed;
  tuning.stop = options.interrupted;
  if (options.starts > 0) tuning.starts = options.starts;
  MeasuredTuneSection section{
      study_measured_tuning(mission_of(antenna), campaign, record, encoder, structures, tuning),
      options.record,
      encoder ? column->name : "",
      "",
      {}};
  section.oil_source = section.oil_fitted ? "fitted to the same record" : "stated by the case";
  if (column && !encoder) section.notes.push_back(unused_column(column->name, record.samples()));
  add_notes(section);
  return section;
}

}  // namespace boresight::app
