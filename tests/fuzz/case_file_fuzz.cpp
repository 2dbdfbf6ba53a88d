// A case file. The folder that files named in it are looked for in does not exist.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    io::parse_case(content, "no-such-folder/case.toml");
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
