#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// Reads one table of a TOML file key by key and remembers what was read, so that a key nobody
/// asked for is an error with the nearest known key as a suggestion.
///
/// Every error is an InvalidInput with one message of the form
///   FILE:LINE:COLUMN: KEY: expected WHAT, found WHAT (REMEDY)
/// where KEY is the full path ("oil.line[1].length") and the column that of the offending token,
/// within a quantity's text too. A missing key stands at its table's header, one of the file itself
/// at the key that may be it misspelt; a syntax error has no KEY.
///
/// A quantity is a text with unit ("0.97 Hz"), or a table with `value` and optionally
/// `uncertainty` (same kind, or relative to |value| as "1 %"), `also` (text or list of texts: the
/// number printed again in other units), `basis` ("measured", "published", "inferred", "assumed"),
/// `source`, `uncertainty_source`. A bare TOML number is refused ("has no unit") except for
/// Kind::number.
///
/// An uncertainty in "%" is always relative, of Kind::number too: value = "5 %" with uncertainty =
/// "1 %" means 0.05 with 0.0005. An absolute one of a plain number is written without unit, "0.01".
class TableReader {
 public:
  /// Parses a file. @throws InvalidInput if it cannot be read or is not TOML (line, column).
  static TableReader open(const std::string& path);
  /// Parses a text; `name` stands for the file in messages.
  static TableReader parse(std::string_view text, const std::string& name);

  TableReader(TableReader&&) noexcept;
  TableReader& operator=(TableReader&&) noexcept;
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;
  ~TableReader();

  /// Whether the table holds the key; does not count as reading it.
  bool has(std::string_view key) const;
  /// Location of a key's value, or of this table if the key is absent.
  Location location(std::string_view key = {}) const;
  /// Full path of a key in this table ("" for the file's own table).
  std::string path(std::string_view key = {}) const;

  /// The value must lie in `range`, which a message states with its unit.
  Quantity quantity(std::string_view key, Kind kind, Range range = {});
  std::optional<Quantity> optional_quantity(std::string_view key, Kind kind, Range range = {});
  /// The quantity, or `value` (SI) where the key is left out: then as assume.
  Quantity quantity_or(std::string_view key, Kind kind, Range range, double value,
                       std::string source);
  /// A number that replaces an absent key; counts as read and as assumed. SI.
  Quantity assume(std::string_view key, Kind kind, double value, std::string source);
  std::string text(std::string_view key);
  std::optional<std::string> optional_text(std::string_view key);
  /// A text out of a closed list; a misspelt one gets the nearest suggested.
  std::string choice(std::string_view key, const std::vector<std::string>& choices);
  long integer(std::string_view key, long minimum, long maximum);
  std::optional<long> optional_integer(std::string_view key, long minimum, long maximum);
  bool boolean(std::string_view key);
  std::optional<bool> optional_boolean(std::string_view key);
  std::vector<std::string> texts(std::string_view key);

  TableReader table(std::string_view key);
  std::optional<TableReader> optional_table(std::string_view key);
  /// An array of tables; absent counts as empty unless `required`.
  std::vector<TableReader> tables(std::string_view key, bool required = false);

  /// Every quantity read so far from the whole file, in the order of reading.
  const std::vector<Quantity>& quantities_read() const;

  /// Refuses every key of this table that was not read. @throws InvalidInput
  void finish() const;
  /// Throws an InvalidInput at the key's location; `message` is the text "expected ..., found ...".
  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;

 private:
  struct Content;
  explicit TableReader(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace boresight::io
