#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/records/column_chooser.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

ColumnChooser::ColumnChooser(const RecordTable& table) : table_(table) {
  for (const auto& column : table.columns) words_.push_back(words_of(column.name));
}

ChosenColumn ColumnChooser::named(const ColumnEntry& entry) const {
  std::vector<std::size_t> found;
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < table_.columns.size(); ++i) {
    names.push_back(table_.columns[i].name);
    if (is_named(table_.columns[i], entry.name)) found.push_back(i);
  }
  if (found.size() == 1) return {found[0], false};
  refuse_at(entry.location, entry.key,
            found.empty() ? fmt::format("expected a column of {}, found {}{} where it has {}",
                                        table_.path, in_quotes(entry.name),
                                        did_you_mean(entry.name, names), columns_of(table_))
                          : fmt::format("expected one column of {}, found {} named {}", table_.path,
                                        found.size(), in_quotes(entry.name)));
}

std::optional<ChosenColumn> ColumnChooser::guessed(
    std::initializer_list<Dimension> kinds, const std::function<bool(const Words&)>& fits) const {
  std::vector<std::size_t> with_unit, without;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (!fits(words_[i])) continue;
    const std::optional<Unit> unit = recorded_unit(table_.columns[i].unit);
    if (!unit) {
      without.push_back(i);
    } else if (std::find(kinds.begin(), kinds.end(), unit->dimension) != kinds.end()) {
      with_unit.push_back(i);
    }
  }
  const auto& found = with_unit.empty() ? without : with_unit;
  return found.size() == 1 ? std::optional(ChosenColumn{found[0], true}) : std::nullopt;
}

bool ColumnChooser::lacks(const std::optional<ColumnEntry>& entry,
                          std::vector<std::string>& remarks) const {
  if (!entry) return false;
  std::vector<std::string_view> names;
  for (const RecordColumn& column : table_.columns) {
    if (is_named(column, entry->name)) return false;
    names.push_back(column.name);
  }
  remarks.push_back(fmt::format("no column {}, which {} names{}: taken as not recorded",
                                in_quotes(entry->name), entry->key,
                                did_you_mean(entry->name, names)));
  return true;
}

void ColumnChooser::refuse_missing(const std::string& what, const std::string& key) const {
  throw InvalidInput(fmt::format(
      "{}: expected a column for the {}, found none or several that could be it among {} (say "
      "which in the case: record_columns.{})",
      table_.path, what, columns_of(table_), key));
}

}  // namespace boresight::io
