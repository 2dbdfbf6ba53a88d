// A MAT file of version 5.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/app/io/record_columns.hpp>
#include <boresight/app/io/record_mat.hpp>
#include <boresight/plant/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    app::is_mat(content);
    const app::RecordTable table = app::read_record_mat(content, "record.mat");
    for (const auto& column : table.columns) app::recorded_unit(column.unit);
    app::choose_columns(table, {}, 1);
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
