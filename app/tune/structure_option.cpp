#include <fmt/format.h>

#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

design::CandidateStructures structure_option(const io::Case& antenna,
                                             const std::vector<std::string>& asked) {
  try {
    return io::asked_structures(antenna, asked);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("--structure: {}", error.what()));
  }
}

}  // namespace boresight::app
