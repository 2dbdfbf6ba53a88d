// A recorder's text file, and what a record made of its columns shows as defects.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <boresight/identification/records/record_defects.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/records/record_text.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/records/servo_columns.hpp>
#include <boresight/numerics/error.hpp>

using namespace boresight;

namespace {

identification::RawChannel channel(const io::RecordColumn& column) {
  identification::RawChannel result;
  result.name = column.name;
  result.values = Eigen::Map<const Eigen::VectorXd>(
      column.values.data(), static_cast<Eigen::Index>(column.values.size()));
  return result;
}

void clean(const io::RecordTable& table) {
  if (table.columns.size() < 6) return;
  identification::RawRecord raw;
  raw.time = channel(table.columns[0]).values;
  raw.inlet = {channel(table.columns[1]), channel(table.columns[2])};
  raw.outlet = {channel(table.columns[3]), channel(table.columns[4])};
  raw.tachometer = channel(table.columns[5]);
  raw.tachometer.upper_limit = 10.0;
  raw.tachometer.lower_limit = -10.0;
  if (table.columns.size() > 6) raw.rate_command = channel(table.columns[6]);
  identification::DefectOptions options;
  options.fewest_samples = 3;
  const auto record = identification::clean_record(raw, options).record;
  if (!record) return;
  for (const auto* signal : {&record->motor_rate, &record->inlet_pressure[0]}) {
    if (signal->values.size() != record->samples() || !signal->values.allFinite()) std::abort();
  }
  if (!(record->sample_time > 0.0)) std::abort();
}

void choose_servo(const io::RecordTable& table) {
  try {
    io::choose_servo_columns(io::Case(), table);
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    const io::RecordTable table = io::read_record_text(content, "record.csv");
    for (const auto& column : table.columns) {
      if (column.values.size() != table.columns[0].values.size()) std::abort();
      io::recorded_unit(column.unit);
    }
    clean(table);
    choose_servo(table);
    io::choose_columns(table, {}, 1, "elevation");
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
