#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// Where a recorder's text file has its names and its first line of numbers.
struct RecordHeader {
  std::vector<RecordColumn> columns;  // names and units, no values
  char separator = ',';
  std::size_t first_row = 0;  // byte at which the first line of numbers begins
  std::vector<std::string> remarks;
};

/// Finds the header: the last line above the first line of two or more numbers that has as many
/// cells (or one more or less), a comment only if no other has. A line of units below the names,
/// "s,psi,V" or "[s],[psi],[V]", is taken as such. Lines skipped are counted in the remarks.
/// @throws InvalidInput as read_record_text
RecordHeader read_record_header(std::string_view content, const std::string& name);

/// Whether a cell, without blanks and quotes around it, is one of the marks for "no number".
bool marks_no_number(std::string_view cell);
/// Without blanks around it, and without the double quotes.
std::string_view unquoted_cell(std::string_view cell);
/// End of the cell that begins at `begin`: at its separator, the line's end or the content's.
std::size_t end_of_cell(std::string_view content, std::size_t begin, char separator);
/// Digits, sign, point, exponent; with `decimal_comma` a comma may stand for the point. NaN if it
/// is no such number, infinite if it does not fit.
double cell_number(std::string_view cell, bool decimal_comma);

/// Ends in "NAME:LINE:COLUMN: MESSAGE" for a byte of the content. @throws InvalidInput always
[[noreturn]] void refuse_record(std::string_view content, std::size_t byte, const std::string& name,
                                const std::string& message);

}  // namespace boresight::io
