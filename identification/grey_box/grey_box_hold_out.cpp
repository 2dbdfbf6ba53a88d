#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_hold_out.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {

GreyBoxHoldOut hold_out_record(const Campaign& campaign, const std::string& name,
                               const std::optional<numerics::Interval>& bulk_modulus,
                               const GreyBoxOptions& options) {
  const auto is_it = [&](const DriveRecord& record) { return record.name == name; };
  const auto held = std::find_if(campaign.records.begin(), campaign.records.end(), is_it);
  if (held == campaign.records.end()) {
    throw InvalidInput(
        fmt::format("hold_out_record: no record of the campaign is named '{}'", name));
  }
  Campaign alone{campaign.knowledge, campaign.instruments, {*held}};
  Campaign rest = campaign;
  std::erase_if(rest.records, is_it);
  const GreyBoxResult result = fit_grey_box(rest, bulk_modulus, options);

  GreyBoxRecordOptions record_options;
  record_options.sample_rate = 1.0 / result.sample_time * (1.0 - 1e-9);
  auto prepared = prepare_records(alone, record_options);
  if (prepared.empty()) {
    throw InvalidInput(fmt::format(
        "hold_out_record: record '{}' has no motor rate or no pressures to be held against", name));
  }
  GreyBoxHoldOut out;
  out.recorded = std::move(prepared.front());
  const GreyBoxParameters& parameters = result.model.at(0);
  out.error = validate_drive(parameters, result.posterior.point, out.recorded);
  GreyBoxManoeuvre manoeuvre;
  manoeuvre.name = name;
  manoeuvre.test = out.recorded.test;
  manoeuvre.sample_time = out.recorded.sample_time;
  manoeuvre.command = out.recorded.valve;
  out.simulated = simulate_drive(parameters, result.posterior.point, manoeuvre);
  return out;
}

}  // namespace boresight::identification
