#include <utility>

#include <fmt/format.h>

#include <boresight/io/campaign/loaded_campaign.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

identification::Instruments make_instruments(const Case& antenna,
                                             std::vector<std::string>& assumptions) {
  identification::Instruments instruments;
  if (const auto& entry = antenna.campaign->instruments) {
    instruments.pressure_gain = entry->pressure_gain.value;
    instruments.pressure_zero = entry->pressure_zero.value;
    instruments.tachometer_scale = entry->tachometer_gain.value;
    if (const auto& valve = entry->valve_command_scale) {
      instruments.valve_scale = valve->standard_uncertainty / valve->value;
    }
  } else if (const auto& recorder = antenna.recorder) {
    instruments.pressure_gain = recorder->pressure_gain.value;
    instruments.pressure_zero = recorder->pressure_zero.value;
    instruments.tachometer_scale = recorder->tachometer_gain.value;
    assumptions.emplace_back(
        "no [instruments]: uncertainties of the simulated [recorder] were taken");
  } else {
    throw InvalidInput(
        fmt::format("{}: instruments: expected the uncertainties of the recorder's channels beside "
                    "records, found none",
                    antenna.path));
  }
  return instruments;
}

}  // namespace

LoadedCampaign load_campaign(const Case& antenna, unsigned threads) {
  if (antenna.campaign->records.empty()) {
    throw InvalidInput(
        fmt::format("{}: record: expected a list of tables [[record]], found none", antenna.path));
  }
  LoadedCampaign loaded;
  CampaignNotes notes;
  loaded.knowledge = drive_knowledge(antenna, notes);
  loaded.assumptions = std::move(notes.assumptions);
  loaded.instruments = make_instruments(antenna, loaded.assumptions);
  loaded.records = load_records(antenna, threads);
  recognise(antenna, loaded.records);
  settle_conflicts(antenna, loaded.records);
  return loaded;
}

}  // namespace boresight::io
