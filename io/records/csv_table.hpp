#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace boresight::io {

/// Columns of numbers with a header, as a data recorder writes them.
struct CsvTable {
  struct Column {
    std::string name;
    std::string unit;
    int decimals = 6;  // digits behind the point
    Eigen::VectorXd values;
  };
  std::vector<Column> columns;
  /// Lines before the header, each written behind "# ".
  std::vector<std::string> comments;
};

/// "# COMMENT" lines, "name [unit],name [unit],...", then a line a sample. Independent of the
/// locale.
/// @throws InvalidInput for columns of different lengths.
std::string to_csv(const CsvTable& table);

}  // namespace boresight::io
