#pragma once

#include <boresight/design/simulation/simulated_record.hpp>
#include <boresight/io/records/csv_table.hpp>

namespace boresight::io {

/// A simulated record as its recorder's file has it; of a run that was ended with a comment that
/// says so.
CsvTable table_of(const design::SimulatedRecord& record);

}  // namespace boresight::io
