// A MAT file of version 5.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/numerics/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    io::is_mat(content);
    const io::RecordTable table = io::read_record_mat(content, "record.mat");
    for (const auto& column : table.columns) io::recorded_unit(column.unit);
    io::choose_columns(table, {}, 1, "elevation");
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
