#pragma once

#include <optional>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

struct SensorsEntry {
  Quantity encoder_noise, tachometer_noise, noise_bandwidth, tachometer_frequency;
  std::optional<Quantity> torque_noise;  // of the torque that a controller feeds back
};

/// The controller's hardware.
struct ControllerEntry {
  Quantity delay;
};

}  // namespace boresight::io
