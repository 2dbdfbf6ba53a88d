#pragma once

namespace boresight::numerics {

/// The value of a function of one number, and its derivative there: of either side at a kink.
struct ValueAndDerivative {
  double value = 0.0;
  double derivative = 0.0;
};

}  // namespace boresight::numerics
