#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/identification/records/record_defects.hpp>
#include <boresight/identification/records/servo_record.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/records/signal_source.hpp>

namespace boresight::io {

/// How a record of the servo was read.
struct ServoRecordNotes {
  std::string path, format;
  std::size_t bytes = 0;
  std::string sha256;  // of the file's bytes, hexadecimal
  std::vector<SignalSource> sources;
  std::vector<std::string> unused_columns;
  /// Of the reader, and columns left out with the reason; a sentence each.
  std::vector<std::string> remarks;
  /// Of the times, and samples without a number.
  std::vector<identification::RecordDefect> defects;
};

/// Reads a recorder file (read_record), named after the file without its folder and extension.
/// Columns: choose_servo_columns. Their scales:
///   angles         at the sky, in any unit of angle. Position command, encoder and wind direction
///                  are made continuous: a step of more than half a turn is taken for a full turn
///   wind speed     in any unit of speed
///   motor rate     volts by [tachometer] of the case (motor_rate_per_volt), samples at its
///                  recorder_limit not valid; a rate in an angular unit is the motor's, that of a
///                  column named after the tachometer its shaft's (tachometer.shaft)
///   rate command   volts, amperes or 1 by instruments.rate_command_scale; an angular rate of
///                  instruments.rate_command_shaft, or at the sky if the case states no shaft
///   valve command  by instruments.valve_command_scale; else volts or amperes by [computer] and
///                  percent of the full stroke, simulation.valve_stroke; an angular rate as it is
/// A command or rate without a scale is left out with a remark, or refused if the case names its
/// column. Columns named in record_columns.reversed have their sign turned. Without a column for
/// the position error it is position command less encoder.
///
/// Times: as clean_record. Samples in gaps, and those that are no number, are not valid, on a
/// straight line between their neighbours. A signal more than half of which is not valid is left
/// out with a remark.
/// @throws InvalidInput, with the file and what was expected and found: as read_record and
/// choose_servo_columns, for fewer than 64 samples, times that cannot be used, more than a fifth of
/// the time in gaps, a column with a unit of another kind or without a scale that the case names,
/// and a file without any signal.
identification::ServoRecord read_servo_record(const Case& antenna, const std::string& path,
                                              ServoRecordNotes& notes);

}  // namespace boresight::io
