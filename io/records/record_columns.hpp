#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/records/column_chooser.hpp>
#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// The columns of a record that hold what is known to be in it; one a motor in order.
struct ChosenColumns {
  ChosenColumn tachometer;
  /// No time only where the case states the sample rate.
  std::optional<ChosenColumn> time, rate_command, valve_command, encoder;
  std::vector<ChosenColumn> inlet, outlet;
  /// Of commands and the encoder that the case names a column for and the file has none of that
  /// name, a sentence each.
  std::vector<std::string> remarks;
};

/// Picks columns: those the case names (any case of letters), others by their names. Words of a
/// name are letters or digits that stand together, "MotorSpeed" has two. A pressure is guessed from
/// a motor's number and in, inlet, a, or out, outlet, b ("p1_in", "PressIn1", "Motor 2 outlet");
/// the tachometer from tach, or speed or rate without a word for command; commands from rate, speed
/// or velocity, or valve or servo, with command, cmd, reference, setpoint or demand (valve alone
/// will do); the time from time or t; the encoder as encoder_by_name. A column of another kind of
/// unit is not guessed, one without a known unit only if none has one that fits, and nothing that
/// two columns could be. A command or encoder that the case names may be missing in a file: see
/// remarks. `axis`: the case's.
/// @throws InvalidInput for a column that the case names and the file has not (but these), or has
/// twice; for a missing or ambiguous pressure, tachometer or time. Lists the file's columns.
ChosenColumns choose_columns(const RecordTable& table, const RecordColumnsEntry& entry, long motors,
                             std::string_view axis);

}  // namespace boresight::io
