#include <tuple>

#include <boresight/io/case/case_computer.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

bool precedes(const Location& a, const Location& b) {
  return std::tie(a.line, a.column) < std::tie(b.line, b.column);
}

void read_valve_command(TableReader& table, ComputerEntry& entry) {
  entry.valve_voltage =
      table.optional_quantity("valve_voltage", Kind::voltage, Range::positive(1e3));
  entry.valve_current =
      table.optional_quantity("valve_current", Kind::current, Range::positive(100.0));
  if (entry.valve_voltage && entry.valve_current) {
    const bool voltage_first =
        precedes(entry.valve_voltage->location, entry.valve_current->location);
    table.refuse(voltage_first ? "valve_current" : "valve_voltage",
                 "expected either valve_voltage or valve_current, found both");
  }
}

void read_transducers(TableReader& table, ComputerEntry& entry) {
  entry.transducer_pressure =
      table.optional_quantity("transducer_pressure", Kind::pressure, Range::positive(1e9));
  entry.transducer_voltage =
      table.optional_quantity("transducer_voltage", Kind::voltage, Range::positive(1e3));
  if (entry.transducer_pressure.has_value() != entry.transducer_voltage.has_value()) {
    table.refuse(entry.transducer_pressure ? "transducer_voltage" : "transducer_pressure",
                 "expected transducer_pressure and transducer_voltage together, found one alone");
  }
}

void read_encoder(TableReader& table, ComputerEntry& entry) {
  constexpr double turn = two_pi;
  entry.encoder_counts = table.optional_integer("encoder_counts", 256, 2147483647);
  entry.encoder_zero =
      table.optional_quantity("encoder_zero", Kind::angle, Range::between(-turn, turn));
  entry.encoder_centre = table.optional_quantity("encoder_centre", Kind::angle,
                                                 Range::between(-2.0 * turn, 2.0 * turn));
}

}  // namespace

void read_computer(TableReader& file, Case& antenna) {
  auto table = file.optional_table("computer");
  if (!table) return;
  ComputerEntry entry;
  read_valve_command(*table, entry);
  read_transducers(*table, entry);
  read_encoder(*table, entry);
  table->finish();
  antenna.computer = entry;
}

}  // namespace boresight::io
