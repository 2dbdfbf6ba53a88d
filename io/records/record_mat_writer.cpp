#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/records/mat_writer.hpp>
#include <boresight/io/records/record_mat_writer.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

std::string to_mat(const CsvTable& record) {
  MatVariables variables;
  if (!record.comments.empty()) {
    variables.add_text("comment", fmt::format("{}", fmt::join(record.comments, "\n")));
  }
  for (const auto& column : record.columns) {
    if (column.values.size() != record.columns.front().values.size()) {
      throw InvalidInput(fmt::format("to_mat: expected {} values in column '{}', found {}",
                                     record.columns.front().values.size(), column.name,
                                     column.values.size()));
    }
    variables.add_matrix(column.name, column.values);
    variables.add_text(column.name + "_unit", column.unit);
  }
  return variables.file("record of a simulated antenna by boresight");
}

}  // namespace boresight::io
