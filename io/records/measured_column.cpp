#include <algorithm>

#include <fmt/format.h>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/measured_column.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

MeasuredColumn measured_column(const RecordTable& table, const ChosenColumn& chosen,
                               const std::optional<ColumnEntry>& entry, const std::string& signal,
                               const std::string& key) {
  const RecordColumn& column = table.columns[chosen.index];
  MeasuredColumn result{column, {}, {signal, column.name, column.unit, chosen.guessed, ""}};
  const std::optional<Unit> own = column.unit.empty() ? std::nullopt : recorded_unit(column.unit);
  if (entry && !entry->unit.empty()) {
    result.unit = parse_unit(entry->unit);
    result.source.unit = entry->unit;
    if (own && (own->factor != result.unit.factor || own->dimension != result.unit.dimension)) {
      refuse_at(entry->location, entry->key,
                fmt::format("expected the unit that {} states, '{}', or none, found '{}'",
                            table.path, column.unit, entry->unit));
    }
    if (!own && !column.unit.empty()) {
      result.source.remark =
          fmt::format("the file states the unit {}, which is not known", in_quotes(column.unit));
    }
  } else if (own) {
    result.unit = *own;
  } else {
    throw InvalidInput(fmt::format(
        "{}: expected a unit of column {}, found {} (say it in the case: record_columns.{} = "
        "\"{} [unit]\")",
        table.path, in_quotes(column.name),
        column.unit.empty() ? "none in the file or the case" : in_quotes(column.unit), key,
        column.name));
  }
  return result;
}

Eigen::VectorXd scaled_values(const RecordColumnsEntry& columns, MeasuredColumn& measured,
                              double factor) {
  const bool turned = std::ranges::any_of(
      columns.reversed, [&](const std::string& name) { return is_named(measured.column, name); });
  std::string& remark = measured.source.remark;
  if (turned) remark += std::string(remark.empty() ? "" : "; ") + "sign turned";
  return Eigen::Map<const Eigen::VectorXd>(
             measured.column.values.data(),
             static_cast<Eigen::Index>(measured.column.values.size())) *
         (turned ? -factor : factor);
}

void refuse_kind(const RecordTable& table, const MeasuredColumn& measured,
                 const std::string& expected) {
  throw InvalidInput(fmt::format("{}: expected {} in column {}, found '{}', {}", table.path,
                                 expected, in_quotes(measured.column.name), measured.source.unit,
                                 measured_by(measured.unit.dimension)));
}

double motor_turns(const Case& antenna, const std::string& shaft, const std::string& what) {
  if (shaft == "motor") return 1.0;
  if (shaft == "antenna") return gear_ratio(antenna);
  const auto& tachometer = antenna.campaign->tachometer;
  if (!tachometer || !tachometer->motor_teeth || !tachometer->tachometer_teeth) {
    throw InvalidInput(
        fmt::format("{}: tachometer.motor_teeth: expected the gear of the tachometer, whose "
                    "shaft {} is about, found none",
                    antenna.path, what));
  }
  return tachometer->motor_teeth->value / tachometer->tachometer_teeth->value;
}

Dimension product(const Dimension& a, const Dimension& b) {
  return {a.length + b.length, a.mass + b.mass,       a.time + b.time,
          a.angle + b.angle,   a.current + b.current, a.level + b.level};
}

}  // namespace boresight::io
