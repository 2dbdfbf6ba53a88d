#pragma once

#include <string>
#include <string_view>

#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// Whether a file begins as a MAT file of any version does.
bool is_mat(std::string_view content);

/// Reads the numeric vectors of a MAT file of version 5 (Octave's and MATLAB's `save -v6` and
/// `-v7`, either byte order): row or column vectors of any integer or real type, columns of a
/// matrix as "data(:,1)", and those in a structure by their field's name. The unit of `tach` may
/// stand in a text `tach_unit` beside it; a structure of `data` (or `values`, `signal`) and `unit`
/// (or `units`) is one column. Lengths may differ. What is no vector of numbers is named in the
/// remarks.
///
/// Every size in the file is checked against the bytes that are there, before memory is taken for
/// it; structures may nest eight deep.
/// @throws InvalidInput naming the file and the byte for a damaged file, for version 7.3 and 4 with
/// the remedy, and for a file without vectors.
RecordTable read_record_mat(std::string_view content, const std::string& name);

}  // namespace boresight::io
