#pragma once

namespace boresight::design {

/// A ratio of rms, after over before, with its interval.
struct RatioBand {
  double value = 0.0, lower = 0.0, upper = 0.0;
};

/// An rms with its interval.
struct RmsBand {
  double value = 0.0, lower = 0.0, upper = 0.0;
};

}  // namespace boresight::design
