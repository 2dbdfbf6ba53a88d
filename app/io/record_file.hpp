#pragma once

#include <string>

#include <boresight/app/io/record_table.hpp>

namespace boresight::app {

/// Reads a recorder file: MAT of version 5 if it begins as one, else text.
/// @throws InvalidInput if it cannot be read, is empty or compressed as a whole, and as
/// read_record_text and read_record_mat do.
RecordTable read_record(const std::string& path);

}  // namespace boresight::app
