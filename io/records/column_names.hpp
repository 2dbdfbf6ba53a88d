#pragma once

#include <string>

#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// Whether a file's column is the one that a case names: equal but for the case of letters, with or
/// without its unit in brackets.
bool is_named(const RecordColumn& column, const std::string& name);

/// "'a', 'b'", the first twenty.
std::string columns_of(const RecordTable& table);

}  // namespace boresight::io
