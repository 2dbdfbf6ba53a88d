#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/records/channel_defects.hpp>
#include <boresight/identification/records/even_time_base.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_computer.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/records/measured_column.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/records/servo_columns.hpp>
#include <boresight/io/records/servo_record_file.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using identification::RawChannel;
using identification::ServoRecord;
using identification::Signal;

constexpr Eigen::Index fewest_samples = 64;
constexpr double largest_gap_fraction = 0.2;
constexpr double largest_invalid_fraction = 0.5;

bool has_word(const RecordColumn& column, const std::string& begin) {
  return std::ranges::any_of(words_of(column.name),
                             [&](const std::string& word) { return word.starts_with(begin); });
}

double invalid_fraction(const Signal& signal) {
  const auto invalid = std::ranges::count(signal.valid, false);
  return static_cast<double>(invalid) / static_cast<double>(signal.values.size());
}

class ServoReader {
 public:
  ServoReader(const Case& antenna, const RecordTable& table, ServoRecordNotes& notes)
      : antenna_(antenna), campaign_(*antenna.campaign), table_(table), notes_(notes) {}

  ServoRecord read() {
    const ServoColumns chosen = choose_servo_columns(antenna_, table_);
    notes_.remarks.insert(notes_.remarks.end(), chosen.remarks.begin(), chosen.remarks.end());
    make_time_base(chosen.time);
    ServoRecord record;
    record.sample_time = base_.sample_time;
    record.position_command = angle(chosen.position_command, "position command", true);
    record.encoder = angle(chosen.encoder, "encoder", true);
    record.position_error = angle(chosen.position_error, "position error", false);
    record.boresight_error = angle(chosen.boresight_error, "boresight error", false);
    record.rate_command = rate_command(chosen.rate_command);
    record.motor_rate = motor_rate(chosen.tachometer);
    record.valve_command = valve_command(chosen.valve_command);
    record.motor_torque = motor_torque(chosen.motor_torque);
    record.wind_speed = wind_speed(chosen.wind_speed);
    record.wind_direction = angle(chosen.wind_direction, "wind direction", true);
    if (signals_ == 0) {
      throw InvalidInput(fmt::format(
          "{}: expected a column of position error, boresight error, encoder, rate, command or "
          "wind with a known unit, found {}",
          table_.path, columns_of(table_)));
    }
    if (!record.position_error && record.position_command && record.encoder) {
      record.position_error = difference(*record.position_command, *record.encoder);
      notes_.sources.push_back(
          {"position error", "", "", false, "none in the file: position command less encoder"});
    }
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!used_.contains(i)) notes_.unused_columns.push_back(table_.columns[i].name);
    }
    return record;
  }

 private:
  void make_time_base(const std::optional<ChosenColumn>& chosen) {
    if (chosen) {
      MeasuredColumn column = measured(*chosen, campaign_.columns.time, "time", "time");
      if (column.unit.dimension != dimension_of(Kind::time)) refuse_kind(table_, column, "a time");
      time_ = scaled_values(campaign_.columns, column, column.unit.factor);
      notes_.sources.push_back(std::move(column.source));
    } else {
      const Quantity& rate = *campaign_.columns.sample_rate;
      const auto samples = static_cast<Eigen::Index>(table_.columns.front().values.size());
      time_ =
          Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1)) / rate.value;
      notes_.sources.push_back({"time", "", "", false, "none in the file: " + rate.text});
    }
    const std::string name = chosen ? table_.columns[chosen->index].name : "time";
    identification::DefectOptions options;
    options.fewest_samples = fewest_samples;
    try {
      base_ = identification::even_time_base(time_, options, notes_.defects);
    } catch (const identification::UnusableTimes& refusal) {
      throw InvalidInput(
          fmt::format("{}: column {}: {}", table_.path, in_quotes(name), refusal.what()));
    }
    const double gaps = invalid_fraction(on_time_base(base_, Eigen::VectorXd::Zero(time_.size())));
    if (gaps > largest_gap_fraction) {
      throw InvalidInput(fmt::format(
          "{}: column {}: expected samples through at least {:.0f} % of the time, found {:.0f} % "
          "(cut the file at its gaps)",
          table_.path, in_quotes(name), 100.0 * (1.0 - largest_gap_fraction),
          100.0 * (1.0 - gaps)));
    }
  }

  MeasuredColumn measured(const ChosenColumn& chosen, const std::optional<ColumnEntry>& entry,
                          const std::string& signal, const std::string& key) {
    used_.insert(chosen.index);
    return measured_column(table_, chosen, chosen.guessed ? std::nullopt : entry, signal, key);
  }

  void leave_out(const RecordColumn& column, const std::string& reason) {
    notes_.remarks.push_back(
        fmt::format("column {} is not used: {}", in_quotes(column.name), reason));
  }

  // A column guessed by its name, without a unit.
  bool lacks_unit(const ChosenColumn& chosen) {
    const RecordColumn& column = table_.columns[chosen.index];
    if (!chosen.guessed || recorded_unit(column.unit)) return false;
    leave_out(column, "it has no known unit");
    return true;
  }

  // On the even grid; `values` are SI.
  std::optional<Signal> signal(MeasuredColumn& column, RawChannel channel) {
    for (auto& defect : identification::missing_samples(channel, time_, false)) {
      notes_.defects.push_back(std::move(defect));
    }
    Signal result = on_time_base(base_, channel.values);
    const double invalid = invalid_fraction(result);
    if (invalid > largest_invalid_fraction) {
      leave_out(column.column,
                fmt::format("{:.0f} % of its samples are not valid", 100.0 * invalid));
      return std::nullopt;
    }
    notes_.sources.push_back(std::move(column.source));
    ++signals_;
    return result;
  }

  std::optional<Signal> scaled(MeasuredColumn& column, double factor) {
    RawChannel channel;
    channel.name = column.column.name;
    channel.values = scaled_values(campaign_.columns, column, factor);
    return signal(column, std::move(channel));
  }

  std::optional<Signal> angle(const std::optional<ChosenColumn>& chosen, const std::string& what,
                              bool continuous) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column = measured(*chosen, std::nullopt, what, "");
    RawChannel channel;
    channel.name = column.column.name;
    channel.values = scaled_values(campaign_.columns, column, column.unit.factor);
    if (continuous) make_continuous(channel.values);
    return signal(column, std::move(channel));
  }

  std::optional<Signal> wind_speed(const std::optional<ChosenColumn>& chosen) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column = measured(*chosen, std::nullopt, "wind speed", "");
    return scaled(column, column.unit.factor);
  }

  // A column without a scale is left out, unless the case names it.
  std::optional<Signal> without_scale(const MeasuredColumn& column, const std::string& expected) {
    const std::string found =
        fmt::format("expected {} for '{}', found none", expected, column.source.unit);
    if (!column.source.guessed) {
      throw InvalidInput(fmt::format("{}: {}, in which {} has column {}", antenna_.path, found,
                                     table_.path, in_quotes(column.column.name)));
    }
    leave_out(column.column, found);
    return std::nullopt;
  }

  std::optional<Signal> motor_rate(const std::optional<ChosenColumn>& chosen) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column =
        measured(*chosen, campaign_.columns.tachometer, "motor rate", "tachometer");
    const auto& tachometer = campaign_.tachometer;
    const bool volts = column.unit.dimension == dimension_of(Kind::voltage);
    double scale = 1.0;
    if (volts) {
      const auto per_volt = motor_rate_per_volt(antenna_);
      if (!per_volt) return without_scale(column, "tachometer.voltage and tachometer.shaft_speed");
      scale = *per_volt;
    } else if (column.unit.dimension != dimension_of(Kind::angular_rate)) {
      refuse_kind(table_, column, "a voltage or an angular rate");
    } else if (tachometer && !has_word(column.column, "motor") &&
               (!chosen->guessed || has_word(column.column, "tach"))) {
      scale = motor_turns(antenna_, tachometer->shaft, "the tachometer");
    }
    RawChannel channel;
    channel.name = column.column.name;
    channel.values = scaled_values(campaign_.columns, column, column.unit.factor * scale);
    const bool limit_in_volts = tachometer && tachometer->voltage;
    if (tachometer && tachometer->recorder_limit && limit_in_volts == volts) {
      channel.upper_limit = tachometer->recorder_limit->value * scale;
      channel.lower_limit = -channel.upper_limit;
      for (auto& defect : identification::mask_clipped(channel, time_, {})) {
        notes_.defects.push_back(std::move(defect));
      }
    }
    return signal(column, std::move(channel));
  }

  // Rate per unit of the column, if the case states one that fits.
  static std::optional<double> stated_scale(const MeasuredColumn& column,
                                            const std::optional<Quantity>& scale) {
    const bool fits = scale && product(dimension_of(scale->kind), column.unit.dimension) ==
                                   dimension_of(Kind::angular_rate);
    return fits ? std::optional(scale->value) : std::nullopt;
  }

  std::optional<Signal> rate_command(const std::optional<ChosenColumn>& chosen) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column =
        measured(*chosen, campaign_.columns.rate_command, "rate command", "rate_command");
    const auto& instruments = campaign_.instruments;
    std::string shaft = instruments ? instruments->rate_command_shaft : "";
    if (shaft.empty()) {
      shaft = has_word(column.column, "motor") ? "motor" : "antenna";
      column.source.remark = "taken as the rate of the " + shaft;
    }
    const double turns = motor_turns(antenna_, shaft, "instruments.rate_command_shaft");
    if (column.unit.dimension == dimension_of(Kind::angular_rate)) {
      return scaled(column, column.unit.factor * turns);
    }
    const auto scale =
        stated_scale(column, instruments ? instruments->rate_command_scale : std::nullopt);
    if (!scale) return without_scale(column, "instruments.rate_command_scale, a rate per unit,");
    return scaled(column, column.unit.factor * *scale * turns);
  }

  // No-load rate of the motors per SI unit of the command, by the computer's full scale.
  std::optional<double> computer_scale(const Dimension& dimension) const {
    if (!antenna_.simulation) return std::nullopt;
    const double stroke = antenna_.simulation->valve_stroke.value;
    if (dimension == dimension_of(Kind::number)) return stroke;
    if (!antenna_.computer) return std::nullopt;
    if (dimension == dimension_of(Kind::voltage) && antenna_.computer->valve_voltage) {
      return stroke / antenna_.computer->valve_voltage->value;
    }
    if (dimension == dimension_of(Kind::current) && antenna_.computer->valve_current) {
      return stroke / antenna_.computer->valve_current->value;
    }
    return std::nullopt;
  }

  std::optional<Signal> valve_command(const std::optional<ChosenColumn>& chosen) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column =
        measured(*chosen, campaign_.columns.valve_command, "valve command", "valve_command");
    if (column.unit.dimension == dimension_of(Kind::angular_rate)) {
      return scaled(column, column.unit.factor);
    }
    const auto& instruments = campaign_.instruments;
    auto scale =
        stated_scale(column, instruments ? instruments->valve_command_scale : std::nullopt);
    if (!scale) scale = computer_scale(column.unit.dimension);
    if (!scale) {
      return without_scale(column,
                           "instruments.valve_command_scale, or simulation.valve_stroke and the "
                           "full scale in [computer],");
    }
    return scaled(column, column.unit.factor * *scale);
  }

  // Of all motors, by the pressure difference between their ports.
  std::optional<Signal> motor_torque(const std::optional<ChosenColumn>& chosen) {
    if (!chosen || lacks_unit(*chosen)) return std::nullopt;
    MeasuredColumn column = measured(*chosen, std::nullopt, "motor torque", "");
    double scale = 1.0;
    if (column.unit.dimension != dimension_of(Kind::torque)) {
      scale = plant::torque_per_pressure(hydraulic_drive(antenna_));
    }
    if (column.unit.dimension == dimension_of(Kind::voltage)) {
      const auto& computer = antenna_.computer;
      if (!computer || !computer->transducer_pressure || !computer->transducer_voltage) {
        return without_scale(column, "computer.transducer_pressure and transducer_voltage");
      }
      scale *= computer->transducer_pressure->value / computer->transducer_voltage->value;
    }
    return scaled(column, column.unit.factor * scale);
  }

  static Signal difference(const Signal& command, const Signal& encoder) {
    Signal result;
    result.values = (command.values - encoder.values).unaryExpr([](double value) {
      return std::remainder(value, two_pi);
    });
    if (command.valid.empty() && encoder.valid.empty()) return result;
    for (Eigen::Index i = 0; i < result.values.size(); ++i) {
      result.valid.push_back(command.is_valid(i) && encoder.is_valid(i));
    }
    return result;
  }

  const Case& antenna_;
  const CampaignEntry& campaign_;
  const RecordTable& table_;
  ServoRecordNotes& notes_;
  Eigen::VectorXd time_;
  identification::EvenTimeBase base_;
  std::set<std::size_t> used_;
  int signals_ = 0;
};

}  // namespace

ServoRecord read_servo_record(const Case& antenna, const std::string& path,
                              ServoRecordNotes& notes) {
  const RecordTable table = read_record(path);
  notes = {};
  notes.path = path;
  notes.format = table.format;
  notes.bytes = table.bytes;
  notes.sha256 = table.sha256;
  notes.remarks = table.remarks;
  ServoRecord record = ServoReader(antenna, table, notes).read();
  record.name = std::filesystem::path(path).stem().string();
  return record;
}

}  // namespace boresight::io
