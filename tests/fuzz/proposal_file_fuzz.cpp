// A proposal of hardware and software.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <boresight/io/proposals/proposal.hpp>
#include <boresight/numerics/error.hpp>

using namespace boresight;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    io::parse_proposal(content, "proposal.toml");
  } catch (const InvalidInput&) {  // refused in words, as it should be
  }
  return 0;
}
