#pragma once

#include <vector>

#include <boresight/app/io/units.hpp>

namespace boresight::app {

inline std::vector<Kind> every_kind() {
  std::vector<Kind> kinds;
  for (int i = 0; i <= static_cast<int>(Kind::level); ++i) {
    kinds.push_back(static_cast<Kind>(i));
  }
  return kinds;
}

}  // namespace boresight::app
