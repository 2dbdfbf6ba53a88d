#pragma once

#include <string>
#include <string_view>

#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// Reads a recorder's text file: a header of names, then a line a sample.
///
/// A name may carry its unit, "p1_in [psi]" or "p1_in (psi)", or the line below the names has the
/// units; names may stand in double quotes. Cells are separated by tab, semicolon or comma,
/// whichever of them, in this order, the header has. The decimal sign is a point, or a comma where
/// the separator is another and no cell has a point. Lines end in LF, CRLF or CR; empty lines and
/// those that begin with '#' or '%' are skipped, but a comment just before the first number that
/// has as many names is taken for the header when no other line has. A byte order mark of UTF-8 is
/// skipped.
///
/// No number (NaN): an empty cell, nan, inf, na, n/a, null, none, -, --, ---, ?, *, in any case, or
/// a line that ends early. A line that ends the file without a line end is left out if it has too
/// few cells or its last number fewer decimals than the one above.
///
/// Takes about as long as std::from_chars takes for the numbers.
/// @throws InvalidInput "NAME:LINE:COLUMN: expected ..., found ..." without header, for a cell that
/// is neither a number nor one of the above, a line with more cells than the header has names,
/// lines that end early more often than not, more than 4096 columns, and bytes that are no text.
RecordTable read_record_text(std::string_view content, const std::string& name);

}  // namespace boresight::io
