#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A recorder file and what was done while it was written.
struct RecordEntry {
  std::string name;
  std::string file;  // as written, relative to the case's folder
  std::string test;  // empty: to be told by the data
  /// "open", "closed"; empty: determined from the test and the data.
  std::string rate_loop;
  std::string description;
  Location location;  // of the file
};

/// The column that holds a signal, and its unit where the file states none.
struct ColumnEntry {
  std::string name;
  std::string unit;
  Location location;
  std::string key;  // "record_columns.tachometer"
};

/// Which columns hold which signals. What is absent is guessed by name.
struct RecordColumnsEntry {
  std::optional<ColumnEntry> time;
  std::vector<ColumnEntry> inlet, outlet;  // one a motor, in the order of the motors; or none
  std::optional<ColumnEntry> tachometer, rate_command, valve_command, encoder;
  /// Names of columns whose sign is turned.
  std::vector<std::string> reversed;
  Location reversed_location;
  std::optional<Quantity> sample_rate;  // of files without times
};

/// Calibration of a recorded campaign, standard errors.
struct InstrumentsEntry {
  Quantity pressure_gain;  // relative
  Quantity pressure_zero;
  Quantity tachometer_gain;  // relative
  std::optional<Quantity> pressure_range;
  /// "motor", "tachometer", "antenna": whose rate rate_command is.
  std::string rate_command_shaft;
  /// rad/s of that shaft per V, A or 1 of the record; absent if recorded as a rate.
  std::optional<Quantity> rate_command_scale;
  /// rad/s of no-load motor speed per V, A or 1 of the record.
  std::optional<Quantity> valve_command_scale;
};

/// The tachometer of a record, in volts or as a rate.
struct RecordedTachometerEntry {
  std::string shaft;  // "motor", "tachometer", "antenna"
  /// Motor turns per tachometer turn as two tooth numbers, for the shaft "tachometer".
  std::optional<Quantity> motor_teeth, tachometer_teeth;
  /// V at the shaft's speed, of one recorded in volts.
  std::optional<Quantity> voltage, shaft_speed;
  /// V, or rad/s of the shaft.
  std::optional<Quantity> recorder_limit;
};

/// An oil line of the drawings, its pressure wave measured or not.
struct LineLength {
  std::string name;
  Quantity length;
};

/// The recorded campaign of a case, in addition to the tables that all cases have.
struct CampaignEntry {
  std::vector<RecordEntry> records;
  RecordColumnsEntry columns;
  std::optional<InstrumentsEntry> instruments;
  std::optional<RecordedTachometerEntry> tachometer;
  std::vector<LineLength> lines;
  /// Of the structure on a locked rotor by a structural model, rising.
  std::vector<Quantity> locked_rotor_frequencies;
  std::optional<Quantity> return_pressure;
};

}  // namespace boresight::io
