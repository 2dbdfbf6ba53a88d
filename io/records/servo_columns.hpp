#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/records/column_chooser.hpp>
#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// The columns of a record of the servo. What could not be recognised is absent.
struct ServoColumns {
  /// Absent only where the case states the sample rate.
  std::optional<ChosenColumn> time;
  std::optional<ChosenColumn> position_command, encoder, position_error, boresight_error;
  std::optional<ChosenColumn> rate_command, tachometer, valve_command, motor_torque;
  std::optional<ChosenColumn> wind_speed, wind_direction;
  /// Of columns that the case names and the file has not, a sentence each.
  std::vector<std::string> remarks;
};

/// Picks columns: time, tachometer, rate_command and valve_command as [record_columns] of the case
/// names them, the others, and those that the file has not, by the words of their names
/// (words_of):
///   wind             wind, anemometer; its speed by a unit of speed, its direction by one of angle
///   boresight error  boresight, pointing, beam or conscan
///   position error   error, err or deviation without those
///   position command command, reference, setpoint or demand, not of a rate
///   encoder          encoder or enc, else position, angle or the axis
///   rate command, tachometer, valve command: as choose_columns
///   motor torque     torque; or pressure with difference, differential or delta
/// Columns of the other axis (az, azimuth; el, elevation) are passed over. A column of another kind
/// of unit is not guessed, and nothing that two columns could be.
/// @throws InvalidInput without a column for the time where the case states no sample rate; lists
/// the file's columns.
ServoColumns choose_servo_columns(const Case& antenna, const RecordTable& table);

}  // namespace boresight::io
