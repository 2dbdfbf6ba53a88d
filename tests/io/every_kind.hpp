#pragma once

#include <vector>

#include <boresight/io/units/units.hpp>

namespace boresight {

inline std::vector<io::Kind> every_kind() {
  std::vector<io::Kind> kinds;
  for (int i = 0; i <= static_cast<int>(io::Kind::level); ++i) {
    kinds.push_back(static_cast<io::Kind>(i));
  }
  return kinds;
}

}  // namespace boresight
