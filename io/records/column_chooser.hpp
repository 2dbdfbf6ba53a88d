#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/records/record_table.hpp>
#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// A column of a file that was taken for a signal.
struct ChosenColumn {
  std::size_t index = 0;
  /// True if recognised by its name; else the case names it.
  bool guessed = false;
};

/// Finds columns of one file, which it refers to: keep the table.
class ColumnChooser {
 public:
  using Words = std::vector<std::string>;

  explicit ColumnChooser(const RecordTable& table);

  /// The column that the case names. @throws InvalidInput for none or several of that name.
  ChosenColumn named(const ColumnEntry& entry) const;

  /// The one column whose words (words_of) fit and whose unit is of one of the kinds, else the one
  /// without a known unit. None if no column or several could be it.
  std::optional<ChosenColumn> guessed(std::initializer_list<Dimension> kinds,
                                      const std::function<bool(const Words&)>& fits) const;

  /// True if the file has no column that the case names; adds a sentence to `remarks` then. A
  /// command may be recorded in some tests only.
  bool lacks(const std::optional<ColumnEntry>& entry, std::vector<std::string>& remarks) const;

  /// @throws InvalidInput, always: no column is the `what`, record_columns.`key` may name it.
  [[noreturn]] void refuse_missing(const std::string& what, const std::string& key) const;

 private:
  const RecordTable& table_;
  std::vector<Words> words_;
};

}  // namespace boresight::io
