#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace boresight::io {

/// A column of a recorder file as it was written, no unit converted.
struct RecordColumn {
  std::string name;
  /// As written behind the name; empty if the file states none.
  std::string unit;
  /// NaN where the file has no number.
  std::vector<double> values;
};

/// The columns of a recorder file.
struct RecordTable {
  std::string path;
  std::size_t bytes = 0;
  /// Of the file's bytes, 64 hexadecimal digits; empty for a table that is of no file.
  std::string sha256;
  /// "comma-separated text", "MAT 5".
  std::string format;
  std::vector<RecordColumn> columns;
  /// What the reader left out or had to take for something, a sentence each.
  std::vector<std::string> remarks;
};

}  // namespace boresight::io
