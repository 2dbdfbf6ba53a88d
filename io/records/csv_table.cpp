#include <iterator>

#include <fmt/format.h>

#include <boresight/io/records/csv_table.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

std::string to_csv(const CsvTable& table) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const auto& comment : table.comments) fmt::format_to(out, "# {}\n", comment);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    if (column.values.size() != table.columns.front().values.size()) {
      throw InvalidInput(fmt::format("to_csv: expected {} values in column '{}', found {}",
                                     table.columns.front().values.size(), column.name,
                                     column.values.size()));
    }
    fmt::format_to(out, "{}{} [{}]", i == 0 ? "" : ",", column.name, column.unit);
  }
  text.push_back('\n');
  const Eigen::Index rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const auto& column = table.columns[i];
      fmt::format_to(out, "{}{:.{}f}", i == 0 ? "" : ",", column.values[row], column.decimals);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace boresight::io
