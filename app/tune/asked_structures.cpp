#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/tune/asked_structures.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

std::vector<std::string> asked_structures(const io::Case& antenna, std::vector<std::string> asked) {
  if (asked.empty()) asked = antenna.tuning.structures;
  if (asked.empty()) {
    asked = {"PI", "DPF", "LL", "FULL", "PI+C", "DPF+C"};
    for (const auto& loop : antenna.loops) asked.push_back(loop.structure.name());
  }
  for (const auto& name : asked) {
    try {
      io::loop_structure(antenna, name);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("--structure: {}", error.what()));
    }
    if (std::ranges::count(asked, name) != 1) {
      throw InvalidInput(
          fmt::format("--structure: expected each structure once, found '{}' again", name));
    }
  }
  return asked;
}

}  // namespace boresight::app
