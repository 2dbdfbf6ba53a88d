#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include <boresight/io/campaign/raw_record.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/records/measured_column.hpp>
#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

using identification::RawChannel;

/// Turns columns of one file into channels.
class Mapper {
 public:
  Mapper(const Case& antenna, const RecordTable& table, RecordNotes& notes)
      : antenna_(antenna), campaign_(*antenna.campaign), table_(table), notes_(notes) {}

  identification::RawRecord map() {
    const RecordColumnsEntry& entry = campaign_.columns;
    const ChosenColumns chosen =
        choose_columns(table_, entry, antenna_.motor->count, antenna_.axis);
    notes_.remarks.insert(notes_.remarks.end(), chosen.remarks.begin(), chosen.remarks.end());
    identification::RawRecord raw;
    raw.tachometer = tachometer(chosen.tachometer);
    raw.time = chosen.time ? time(*chosen.time) : even_times(raw.tachometer.values.size());
    for (std::size_t motor = 0; motor < chosen.inlet.size(); ++motor) {
      raw.inlet.push_back(pressure(chosen.inlet[motor], entry.inlet, motor, "inlet"));
      raw.outlet.push_back(pressure(chosen.outlet[motor], entry.outlet, motor, "outlet"));
    }
    if (chosen.rate_command) raw.rate_command = rate_command(*chosen.rate_command);
    if (chosen.valve_command) raw.valve_command = valve_command(*chosen.valve_command);
    if (chosen.encoder) raw.encoder = encoder(*chosen.encoder);
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!used_.contains(i)) notes_.unused_columns.push_back(table_.columns[i].name);
    }
    notes_.rows = static_cast<std::size_t>(raw.time.size());
    return raw;
  }

 private:
  // A column with its unit. A column serves one signal.
  MeasuredColumn measured(const ChosenColumn& chosen, const std::optional<ColumnEntry>& entry,
                          const std::string& signal, const std::string& key) {
    if (!used_.insert(chosen.index).second) {
      throw InvalidInput(
          fmt::format("{}: expected a column for each signal, found {} taken for two "
                      "(say which is which in [record_columns])",
                      table_.path, in_quotes(table_.columns[chosen.index].name)));
    }
    return measured_column(table_, chosen, entry, signal, key);
  }

  RawChannel channel(MeasuredColumn measured, double factor) {
    RawChannel result;
    result.name = measured.column.name;
    result.values = scaled_values(campaign_.columns, measured, factor);
    notes_.sources.push_back(std::move(measured.source));
    return result;
  }

  Eigen::VectorXd time(const ChosenColumn& chosen) {
    const MeasuredColumn column = measured(chosen, campaign_.columns.time, "time", "time");
    if (column.unit.dimension != dimension_of(Kind::time)) refuse_kind(table_, column, "a time");
    return channel(column, column.unit.factor).values;
  }

  Eigen::VectorXd even_times(Eigen::Index samples) {
    const auto& rate = campaign_.columns.sample_rate;
    if (!rate) throw InvalidInput("even_times: no sample rate");
    notes_.sources.push_back({"time", "", "", false, "none in the file: " + rate->text});
    return Eigen::VectorXd::LinSpaced(samples, 0.0,
                                      static_cast<double>(std::max<Eigen::Index>(samples - 1, 0))) /
           rate->value;
  }

  RawChannel pressure(const ChosenColumn& chosen, const std::vector<ColumnEntry>& entries,
                      std::size_t motor, const std::string& side) {
    const MeasuredColumn column =
        measured(chosen, entries.empty() ? std::nullopt : std::optional(entries[motor]),
                 fmt::format("{} pressure {}", side, motor + 1), side);
    if (column.unit.dimension != dimension_of(Kind::pressure))
      refuse_kind(table_, column, "a pressure");
    RawChannel result = channel(column, column.unit.factor);
    if (campaign_.instruments && campaign_.instruments->pressure_range) {
      result.upper_limit = campaign_.instruments->pressure_range->value;
      // A transducer shows nothing below zero, unless it is one for either sign.
      if (4 * (result.values.array() < 0.0).count() < result.values.size()) {
        result.lower_limit = 0.0;
      }
    }
    return result;
  }

  RawChannel tachometer(const ChosenColumn& chosen) {
    const MeasuredColumn column =
        measured(chosen, campaign_.columns.tachometer, "tachometer", "tachometer");
    const bool volts = column.unit.dimension == dimension_of(Kind::voltage);
    if (!volts && column.unit.dimension != dimension_of(Kind::angular_rate)) {
      refuse_kind(table_, column, "a voltage or an angular rate");
    }
    const auto& entry = campaign_.tachometer;
    if (!entry || (volts && !entry->voltage)) {
      throw InvalidInput(fmt::format(
          "{}: tachometer{}: expected {} of the tachometer, which {} has in '{}', found none",
          antenna_.path, entry ? ".voltage" : "",
          volts ? "voltage and shaft_speed" : "shaft (whose rate it is)", table_.path,
          column.source.unit));
    }
    const double gear = motor_turns(antenna_, entry->shaft, "the tachometer");
    const double per_volt = entry->voltage && entry->shaft_speed
                                ? gear * entry->shaft_speed->value / entry->voltage->value
                                : 0.0;
    RawChannel result = channel(column, column.unit.factor * (volts ? per_volt : gear));
    if (entry->recorder_limit) {
      result.upper_limit = entry->recorder_limit->value * (entry->voltage ? per_volt : gear);
      result.lower_limit = -result.upper_limit;
    }
    return result;
  }

  // A command that cannot be scaled is left out, unless the case names its column.
  std::optional<RawChannel> left_out(const MeasuredColumn& column, bool wanted,
                                     const std::string& reason) {
    if (wanted) {
      throw InvalidInput(fmt::format("{}: {} for {} of {}, found none", antenna_.path, reason,
                                     in_quotes(column.column.name), table_.path));
    }
    notes_.remarks.push_back(fmt::format("column {} is not used: {}, found none",
                                         in_quotes(column.column.name), reason));
    return std::nullopt;
  }

  std::optional<RawChannel> scaled(const MeasuredColumn& column,
                                   const std::optional<Quantity>& scale, double gear, bool wanted,
                                   const std::string& key) {
    if (!scale) {
      return left_out(column, wanted,
                      fmt::format("instruments.{}: expected a rate per recorded unit, '{}',", key,
                                  column.source.unit));
    }
    if (product(dimension_of(scale->kind), column.unit.dimension) !=
        dimension_of(Kind::angular_rate)) {
      refuse_at(scale->location, scale->key,
                fmt::format("expected a rate per '{}', in which {} has column {}, found {}",
                            column.source.unit, table_.path, in_quotes(column.column.name),
                            in_quotes(scale->text)));
    }
    return channel(column, column.unit.factor * scale->value * gear);
  }

  // A column guessed for a command, without a unit: nothing can be said of it.
  bool lacks_unit(const ChosenColumn& chosen) {
    const RecordColumn& column = table_.columns[chosen.index];
    if (!chosen.guessed || recorded_unit(column.unit)) return false;
    notes_.remarks.push_back(
        fmt::format("column {} is not used: it has no known unit", in_quotes(column.name)));
    return true;
  }

  std::optional<RawChannel> rate_command(const ChosenColumn& chosen) {
    if (lacks_unit(chosen)) return std::nullopt;
    const auto& entry = campaign_.columns.rate_command;
    const MeasuredColumn column = measured(chosen, entry, "rate command", "rate_command");
    const auto& instruments = campaign_.instruments;
    const std::string shaft = instruments ? instruments->rate_command_shaft : "";
    if (shaft.empty()) {
      return left_out(column, entry.has_value(),
                      "instruments.rate_command_shaft: expected whose rate it is, 'motor', "
                      "'tachometer' or 'antenna',");
    }
    const double gear = motor_turns(antenna_, shaft, "instruments.rate_command_shaft");
    if (column.unit.dimension == dimension_of(Kind::angular_rate)) {
      return channel(column, column.unit.factor * gear);
    }
    return scaled(column, instruments ? instruments->rate_command_scale : std::nullopt, gear,
                  entry.has_value(), "rate_command_scale");
  }

  std::optional<RawChannel> valve_command(const ChosenColumn& chosen) {
    if (lacks_unit(chosen)) return std::nullopt;
    const auto& entry = campaign_.columns.valve_command;
    const MeasuredColumn column = measured(chosen, entry, "valve command", "valve_command");
    if (column.unit.dimension == dimension_of(Kind::angular_rate)) {
      return channel(column, column.unit.factor);
    }
    const auto& instruments = campaign_.instruments;
    return scaled(column, instruments ? instruments->valve_command_scale : std::nullopt, 1.0,
                  entry.has_value(), "valve_command_scale");
  }

  std::optional<RawChannel> encoder(const ChosenColumn& chosen) {
    if (lacks_unit(chosen)) return std::nullopt;
    const MeasuredColumn column = measured(chosen, campaign_.columns.encoder, "encoder", "encoder");
    if (column.unit.dimension != dimension_of(Kind::angle)) {
      refuse_kind(table_, column, "an angle at the sky");
    }
    RawChannel result = channel(column, column.unit.factor);
    make_continuous(result.values);
    return result;
  }

  const Case& antenna_;
  const CampaignEntry& campaign_;
  const RecordTable& table_;
  RecordNotes& notes_;
  std::set<std::size_t> used_;
};

}  // namespace

identification::RawRecord raw_record(const Case& antenna, const RecordTable& table,
                                     RecordNotes& notes) {
  return Mapper(antenna, table, notes).map();
}

}  // namespace boresight::io
