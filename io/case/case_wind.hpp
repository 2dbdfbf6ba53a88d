#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/io/units/quantity.hpp>
#include <boresight/plant/wind/gust_spectrum.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind_mast.hpp>
#include <boresight/plant/wind/wind_record.hpp>

namespace boresight::io {

struct WindEntry {
  Quantity air_density, torque_coefficient, gradient_coefficient, coherence_decay;
  Quantity design_speed;
  std::optional<plant::WindMast> mast;  // none: speeds are stated for the dish's centre
  std::string model;
  plant::GustSpectrum gusts;
  /// How often which mean speed blows; empty: not stated.
  std::vector<design::WeightedSpeed> climate;
  std::vector<design::ClimatePart> climate_parts;  // the same as the case states it
  /// Root of the mean square of the torque coefficients over the attitudes that the case gives.
  std::optional<double> climate_torque_coefficient;
  /// Torque coefficients over yaw and elevation; torque_coefficient is then the table's.
  std::optional<plant::TorqueCoefficientTable> torque_table;
  std::optional<plant::WindAttitude> attitude;
  /// A measured wind, for simulated tracking.
  std::optional<plant::WindRecord> record;
  std::string record_path;
};

}  // namespace boresight::io
