// Somebody else's controller: a MAT file of version 5, else JSON.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/app/io/controller_file.hpp>
#include <boresight/app/io/record_mat.hpp>
#include <boresight/plant/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    if (app::is_mat(content)) {
      app::controller_from_mat(content, "controller.mat");
    } else {
      app::controller_from_json(content, "controller.json");
    }
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
