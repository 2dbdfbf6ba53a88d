#include <fmt/format.h>

#include <boresight/control/controllers/usual_structures.hpp>

namespace boresight::control {

const std::vector<std::string>& usual_structures() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto* base : {"PI-0", "PI", "DPF", "LL", "FULL"}) {
      for (const auto* lag : {"", "+L"}) {
        for (const auto* condition : {"", "+D", "+F"}) {
          for (const auto* added : {"", "+N", "+C", "+N+C"}) {
            all.push_back(fmt::format("{}{}{}{}", base, lag, condition, added));
          }
        }
      }
    }
    return all;
  }();
  return names;
}

std::string short_name(const LoopStructure& structure) {
  for (const auto& name : usual_structures()) {
    if (LoopStructure::named(name) == structure) return name;
  }
  return structure.name();
}

}  // namespace boresight::control
