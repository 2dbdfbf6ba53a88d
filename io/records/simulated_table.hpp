#pragma once

#include <boresight/design/simulation/simulated_record.hpp>
#include <boresight/io/records/csv_table.hpp>

namespace boresight::io {

/// A simulated record in the form of its recorder's file; a run that ended early has a comment that
/// states this.
CsvTable table_of(const design::SimulatedRecord& record);

}  // namespace boresight::io
