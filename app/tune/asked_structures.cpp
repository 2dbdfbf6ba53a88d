#include <fmt/format.h>

#include <boresight/app/tune/asked_structures.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

std::vector<design::NamedStructure> asked_structures(const io::Case& antenna,
                                                     const std::vector<std::string>& asked) {
  try {
    return io::asked_structures(antenna, asked);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("--structure: {}", error.what()));
  }
}

}  // namespace boresight::app
