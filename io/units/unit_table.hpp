#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// A column of a table file. A name that ends in '*' stands for any number of columns, at least one
/// if needed, whose names begin so.
struct UnitTableColumn {
  std::string name;
  Kind kind = Kind::number;
  bool needed = true;
};

/// Reads a CSV file of numbers: lines that begin with '#' are comments, then a header
/// "name [unit],name [unit],...", then a line of as many numbers a row. A plain number's column may
/// do without "[unit]". Any order of columns.
/// @returns the columns by name, SI units (frequencies in Hz), all of the same length, which is at
/// least 1. @throws InvalidInput with file and line, what was expected and what was found, for a
/// file that cannot be read or is larger than 256 MB, an unknown, missing or repeated column, a
/// unit of another kind, a row of another length, and what is no finite number.
std::map<std::string, Eigen::VectorXd> read_unit_table(const std::string& path,
                                                       const std::vector<UnitTableColumn>& columns);

/// The path that a text of a case file names: relative to the case file's folder.
std::string beside_case(const std::string& case_path, const std::string& name);

}  // namespace boresight::io
