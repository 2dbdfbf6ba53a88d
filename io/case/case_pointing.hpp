#pragma once

#include <optional>
#include <string>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

struct BandEntry {
  std::string name;
  Quantity frequency;
  Quantity beamwidth_factor;  // as stated, or by the illumination
  std::string illumination;   // in words; empty if the factor is stated
};

/// A pointing budget: a loss in a band by a named convention, or an rms error per axis.
struct BudgetEntry {
  std::string name;
  std::string band;
  std::optional<Quantity> loss;  // dB
  std::string convention;
  std::optional<Quantity> rms;
  std::optional<Quantity> wind_speed;  // up to which it must be met
};

}  // namespace boresight::io
