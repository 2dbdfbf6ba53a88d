#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A line whose pressure wave was measured.
struct OilLine {
  std::string name;
  Quantity length;
  Quantity slosh_frequency;
};

struct OilEntry {
  std::optional<Quantity> density;       // always where there are lines, known by length or wave
  std::optional<Quantity> bulk_modulus;  // else the mean over the lines
  Quantity volume_1;
  Quantity volume_2;
  bool efficiency_in_stiffness = true;
  std::vector<OilLine> lines;
};

}  // namespace boresight::io
