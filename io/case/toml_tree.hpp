#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::io {

enum class TomlType { text, integer, number, boolean, date, list, table };

struct TomlEntry;

/// A value of a TOML file and where it stands (from 1; columns are characters). Keeps the rest of
/// the program from the TOML library, whose headers are slow to compile.
struct TomlNode {
  TomlType type = TomlType::table;
  int line = 1;
  int column = 1;
  /// Content of a text; an integer or number as it is written, digit for digit.
  std::string text;
  /// The text's characters stand in the file one by one behind one quotation mark, so that the
  /// place of any of them is known.
  bool verbatim = false;
  std::int64_t integer = 0;
  bool boolean = false;
  std::vector<TomlNode> elements;
  /// Of a table, in the order of the file.
  std::vector<TomlEntry> entries;

  /// The value of a table's key, or none.
  const TomlNode* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  int line = 1;
  int column = 1;
  TomlNode value;
};

/// Parses a text; `name` stands for the file in messages.
/// @throws InvalidInput "NAME:LINE:COLUMN: expected valid TOML, found ..."
TomlNode parse_toml(std::string_view text, const std::string& name);

}  // namespace boresight::io
