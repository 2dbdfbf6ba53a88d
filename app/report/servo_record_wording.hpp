#pragma once

#include <string>
#include <vector>

#include <boresight/io/records/servo_record_file.hpp>

namespace boresight::app {

/// How a record of the servo was read, in sentences: the column and unit of each signal, what is
/// inferred, columns that are not used, samples that are missing or masked, remarks of the reader.
std::vector<std::string> reading_of(const io::ServoRecordNotes& notes);

}  // namespace boresight::app
