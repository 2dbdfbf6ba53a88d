#pragma once

#include <string>

#include <boresight/io/records/record_table.hpp>

namespace boresight::io {

/// Reads a recorder file: MAT of version 5 if it begins as one, else text.
/// @throws InvalidInput if it cannot be read, is empty, compressed as a whole or becomes shorter
/// meanwhile, and as read_record_text and read_record_mat do.
RecordTable read_record(const std::string& path);

}  // namespace boresight::io
