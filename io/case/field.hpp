#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/case/toml_tree.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// One value of a case file, with what a message about it needs.
struct Field {
  const TomlNode& node;
  /// Full key path, "oil.line[1].length".
  std::string path;
  const std::string& file;

  Location location() const { return {file, node.line, node.column}; }
};

/// "FILE:LINE:COLUMN: PATH: MESSAGE". @throws InvalidInput always
[[noreturn]] void refuse_at(const Location& location, std::string_view path,
                            std::string_view message);

/// Ends in "expected EXPECTED, found (what stands there)REMEDY". @throws InvalidInput always
[[noreturn]] void refuse_field(const Field& field, std::string_view expected,
                               std::string_view remedy = {});

/// " (did you mean 'NAME'?)", or nothing if no known name is near.
std::string did_you_mean(std::string_view misspelt, const std::vector<std::string_view>& known);
/// "'a', 'b'"
std::string quoted_list(const std::vector<std::string_view>& names);

// Each reads the value of a field, or ends in an InvalidInput at its place.
std::string read_text(const Field& field);
std::vector<std::string> read_texts(const Field& field);
std::string read_choice(const Field& field, const std::vector<std::string>& choices);
long read_integer(const Field& field, long minimum, long maximum);
bool read_boolean(const Field& field);

/// A number with unit, or a bare number if the kind has no unit; a message points into the text.
PrintedNumber read_printed(const Field& field, Kind kind);
/// One number or a list of them.
std::vector<PrintedNumber> read_printed_list(const Field& field, Kind kind);
/// The standard uncertainty of `of`: absolute, or relative if in "%".
double read_uncertainty(const Field& field, const Quantity& of);
/// Refuses a number outside the range.
void check_range(const Field& field, const PrintedNumber& number, Kind kind, const Range& range);

}  // namespace boresight::io
