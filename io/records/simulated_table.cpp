#include <fmt/format.h>

#include <boresight/io/records/simulated_table.hpp>

namespace boresight::io {

CsvTable table_of(const design::SimulatedRecord& record) {
  CsvTable table;
  for (const auto& channel : record.channels) {
    table.columns.push_back({channel.name, channel.unit, channel.decimals, channel.values});
  }
  if (!record.complete) {
    table.comments.push_back(fmt::format("incomplete: interrupted after {:.3f} s of {:.3f} s",
                                         record.duration, record.planned_duration));
  }
  return table;
}

}  // namespace boresight::io
