#pragma once

#include <complex>
#include <vector>

#include <boresight/numerics/complex_packs.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::plant {

/// PlantResponse at one frequency.
struct ResponsePoint {
  std::complex<double> tachometer_command, torque_command, encoder_command, boresight_command;
  std::complex<double> tachometer_wind, torque_wind, encoder_wind, boresight_wind;
};

/// One point of a response on a grid.
ResponsePoint point(const PlantResponse& response, Eigen::Index i);
void set_point(PlantResponse& response, Eigen::Index i, const ResponsePoint& point);
/// A response at these frequencies (rad/s) whose points are still to be set.
PlantResponse unset_response(const Eigen::ArrayXd& frequency);

/// StructureResponse at one frequency.
struct StructurePoint {
  std::complex<double> inertial_stiffness, gear_stiffness;
  std::complex<double> wind_at_bull_gear, boresight_per_bull_gear, boresight_per_wind;
};

/// The drive closed onto what it sees of the structure; `frequency`: rad/s.
ResponsePoint drive_on_structure(const Drive& drive, const StructurePoint& structure,
                                 double frequency);

/// The response of a plant at single frequencies, eight modes at a time and without allocation: for
/// searches that look between the points of a grid.
class PointResponse {
 public:
  explicit PointResponse(const AntennaPlant& plant);
  /// `frequency`: rad/s, above 0.
  ResponsePoint operator()(double frequency) const;

 private:
  struct ModePack {
    numerics::RealPack inertia, stiffness, damping, wind_fraction, beam_weight;
  };
  struct ModeSum;
  Drive drive_;
  Structure structure_;  // without modes
  std::vector<ModePack> modes_;
};

}  // namespace boresight::plant
