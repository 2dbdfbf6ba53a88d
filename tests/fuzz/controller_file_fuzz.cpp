// Somebody else's controller: a MAT file of version 5, else JSON.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/numerics/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    if (io::is_mat(content)) {
      io::controller_from_mat(content, "controller.mat");
    } else {
      io::controller_from_json(content, "controller.json");
    }
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
