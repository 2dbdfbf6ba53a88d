#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

// Whether a key is there; from now on it is one that may be.
bool may_have(TableReader& table, std::string_view key) {
  return table.has(key) || table.optional_text(key).has_value();
}

// "p1_in [psi]": name and unit.
ColumnEntry read_column(TableReader& table, const std::string& key, const std::string& text) {
  ColumnEntry column;
  column.location = table.location(key);
  column.key = table.path(key);
  const std::size_t open = text.rfind('[');
  const bool unit = !text.empty() && text.back() == ']' && open != std::string::npos;
  column.name = text.substr(0, unit ? open : text.size());
  while (!column.name.empty() && column.name.back() == ' ') column.name.pop_back();
  if (unit) column.unit = text.substr(open + 1, text.size() - open - 2);
  if (column.name.empty() || (unit && column.unit.empty())) {
    table.refuse(key, fmt::format("expected a column's name, with its unit in brackets if the file "
                                  "states none ('tach [V]'), found {}",
                                  in_quotes(text)));
  }
  if (unit) {
    try {
      parse_unit(column.unit);
    } catch (const UnitError& error) {
      table.refuse(key, error.what());
    }
  }
  return column;
}

std::optional<ColumnEntry> read_optional_column(TableReader& table, const std::string& key) {
  const std::optional<std::string> text = table.optional_text(key);
  return text ? std::optional(read_column(table, key, *text)) : std::nullopt;
}

std::vector<ColumnEntry> read_motor_columns(TableReader& table, const std::string& key,
                                            long motors) {
  std::vector<ColumnEntry> columns;
  if (!may_have(table, key)) return columns;
  for (const std::string& text : table.texts(key)) {
    columns.push_back(read_column(table, key, text));
  }
  if (columns.size() != static_cast<std::size_t>(motors)) {
    table.refuse(key, fmt::format("expected a column for each of {} motors, found {}", motors,
                                  columns.size()));
  }
  return columns;
}

RecordColumnsEntry read_columns(TableReader& table, long motors) {
  RecordColumnsEntry entry;
  entry.time = read_optional_column(table, "time");
  entry.inlet = read_motor_columns(table, "inlet", motors);
  entry.outlet = read_motor_columns(table, "outlet", motors);
  entry.tachometer = read_optional_column(table, "tachometer");
  entry.rate_command = read_optional_column(table, "rate_command");
  entry.valve_command = read_optional_column(table, "valve_command");
  entry.encoder = read_optional_column(table, "encoder");
  if (may_have(table, "reversed")) {
    entry.reversed = table.texts("reversed");
    entry.reversed_location = table.location("reversed");
  }
  entry.sample_rate =
      table.optional_quantity("sample_rate", Kind::frequency, Range::between(0.1, 1e6));
  if (entry.time && entry.sample_rate) {
    table.refuse("sample_rate", "expected either time or sample_rate, found both");
  }
  table.finish();
  return entry;
}

// The number and unit of a quantity, a text or a table's `value`.
std::string quantity_text(TableReader& table, const std::string& key) {
  try {
    return table.text(key);
  } catch (const InvalidInput&) {
    return table.table(key).text("value");
  }
}

// A rate per recorded unit, whatever that unit is: the unit tells the kind, and what else is wrong
// with the quantity is then said of that kind.
std::optional<Quantity> read_scale(TableReader& table, const std::string& key) {
  if (!may_have(table, key)) return std::nullopt;
  const std::string text = quantity_text(table, key);
  for (const Kind kind : {Kind::tachometer_scale, Kind::rate_per_current, Kind::angular_rate}) {
    try {
      parse_quantity(text, kind);
    } catch (const UnitError&) {
      continue;
    }
    return table.quantity(key, kind, Range::positive());
  }
  table.refuse(key, fmt::format("expected a rate per recorded volt, ampere or 1, above 0 (such as "
                                "14 rad/(s.V), 2 rad/(s.mA), 150 rad/s), found {}",
                                in_quotes(text)));
}

InstrumentsEntry read_instruments(TableReader& table) {
  InstrumentsEntry entry;
  const Range fraction = Range::between(0.0, 0.5);
  entry.pressure_gain = table.quantity("pressure_gain", Kind::number, fraction);
  entry.pressure_zero = table.quantity("pressure_zero", Kind::pressure, Range::not_negative(1e9));
  entry.tachometer_gain = table.quantity("tachometer_gain", Kind::number, fraction);
  entry.pressure_range =
      table.optional_quantity("pressure_range", Kind::pressure, Range::positive(1e10));
  if (may_have(table, "rate_command_shaft")) {
    entry.rate_command_shaft =
        table.choice("rate_command_shaft", {"motor", "tachometer", "antenna"});
  }
  entry.rate_command_scale = read_scale(table, "rate_command_scale");
  entry.valve_command_scale = read_scale(table, "valve_command_scale");
  table.finish();
  if (entry.rate_command_scale && entry.rate_command_shaft.empty()) {
    table.refuse("rate_command_shaft",
                 "expected 'motor', 'tachometer' or 'antenna' beside rate_command_scale, found "
                 "nothing");
  }
  return entry;
}

}  // namespace

void read_campaign(TableReader& file, Case& antenna) {
  CampaignEntry& campaign = *antenna.campaign;
  std::set<std::string> names;
  for (auto& table : file.tables("record")) {
    RecordEntry entry;
    entry.file = table.text("file");
    entry.location = table.location("file");
    if (entry.file.empty()) table.refuse("file", "expected a file's name, found an empty text");
    entry.name = may_have(table, "name") ? table.text("name")
                                         : std::filesystem::path(entry.file).stem().string();
    if (!names.insert(entry.name).second) {
      table.refuse(table.has("name") ? "name" : "file",
                   "expected a name of its own, found " + in_quotes(entry.name) + " again");
    }
    if (may_have(table, "test")) {
      entry.test = table.choice("test", {"slosh", "fast-ramp", "slow-ramp", "constant-speed",
                                         "valve-steps", "valve-chirp", "other"});
    }
    if (may_have(table, "rate_loop"))
      entry.rate_loop = table.choice("rate_loop", {"open", "closed"});
    entry.description = table.optional_text("description").value_or("");
    table.finish();
    campaign.records.push_back(std::move(entry));
  }
  if (auto table = file.optional_table("record_columns")) {
    campaign.columns = read_columns(*table, antenna.motor->count);
  }
  if (auto table = file.optional_table("instruments")) {
    campaign.instruments = read_instruments(*table);
  }
}

}  // namespace boresight::io
