#pragma once

namespace boresight::numerics {

/// A number with its standard uncertainty, SI.
struct Uncertain {
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

}  // namespace boresight::numerics
