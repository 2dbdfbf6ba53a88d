#pragma once

#include <optional>
#include <string>

namespace boresight::design {

/// A pointing budget as rms error per axis.
struct PointingBudget {
  std::string name;
  std::string band;
  double beamwidth = 0.0;            // rad
  double rms = 0.0;                  // rad
  std::string convention;            // in words
  std::optional<double> wind_speed;  // m/s, up to which it must be met
};

/// A radio band in which the antenna receives or transmits.
struct PointingBand {
  std::string name;
  double frequency = 0.0;    // Hz
  double beamwidth = 0.0;    // rad
  std::string illumination;  // basis of the beamwidth; empty if its factor is stated
};

}  // namespace boresight::design
