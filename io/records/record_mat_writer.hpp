#pragma once

#include <string>

#include <boresight/io/records/csv_table.hpp>

namespace boresight::io {

/// A record as a MAT file of version 5 that read_record_mat reads back bit by bit: a column vector
/// of doubles and a text NAME_unit for every column, the comments as lines of the text `comment`.
/// @throws InvalidInput for columns of different lengths, and names that MATLAB does not take.
std::string to_mat(const CsvTable& record);

}  // namespace boresight::io
