#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::plant {

StructureResponse structure_response(const Structure& structure, const Eigen::ArrayXd& frequency) {
  const Eigen::Index count = frequency.size();
  StructureResponse response{frequency,
                             Eigen::ArrayXcd(count),
                             Eigen::ArrayXcd(count),
                             Eigen::ArrayXcd(count),
                             Eigen::ArrayXcd(count),
                             Eigen::ArrayXcd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::complex<double> s{0.0, frequency[i]};
    const std::complex<double> s2 = s * s;
    std::complex<double> inertial = structure.bull_gear_inertia * s2;
    std::complex<double> wind = structure.bull_gear_wind_fraction;
    std::complex<double> boresight = structure.bull_gear_beam_weight;
    std::complex<double> bending = 0.0;
    for (const auto& mode : structure.modes) {
      const std::complex<double> spring = mode.stiffness + s * mode.damping;
      const std::complex<double> inverse = 1.0 / (mode.inertia * s2 + spring);
      const std::complex<double> follow = spring * inverse;
      inertial += follow * mode.inertia * s2;
      wind += follow * mode.wind_fraction;
      boresight += follow * mode.beam_weight;
      bending += inverse * (mode.wind_fraction * mode.beam_weight);
    }
    response.inertial_stiffness[i] = inertial;
    response.gear_stiffness[i] = structure.gear_stiffness + s * structure.gear_damping;
    response.wind_at_bull_gear[i] = wind;
    response.boresight_per_bull_gear[i] = boresight;
    response.boresight_per_wind[i] = bending;
  }
  return response;
}

ResponsePoint drive_on_structure(const Drive& drive, const StructurePoint& structure,
                                 double frequency) {
  const double wv = drive.valve_corner;
  const std::complex<double> s{0.0, frequency};
  const std::complex<double> valve =
      wv * wv / (s * s + 2.0 * drive.valve_damping * wv * s + wv * wv);
  const std::complex<double> oil = drive.oil_stiffness / (s + drive.leakage_rate);
  const std::complex<double> own = drive.motor_inertia * s * s + drive.viscous_friction * s;
  const std::complex<double> a = own + oil * s;
  const std::complex<double> b = structure.inertial_stiffness;
  const std::complex<double> g = structure.gear_stiffness;
  // det of [[g+a, -g], [-g, g+b]] without the cancelling g^2
  const std::complex<double> inverse = 1.0 / (g * (a + b) + a * b);
  const std::complex<double> push = oil * valve * inverse;
  const std::complex<double> wind = structure.wind_at_bull_gear * inverse;
  const std::complex<double> lag = drive.tachometer_corner / (s + drive.tachometer_corner);

  ResponsePoint point;
  point.tachometer_command = s * lag * (g + b) * push;
  point.torque_command = (own * (g + b) + g * b) * push;
  point.encoder_command = g * push;
  point.boresight_command = structure.boresight_per_bull_gear * g * push;
  point.tachometer_wind = s * lag * g * wind;
  point.torque_wind = -g * oil * s * wind;
  point.encoder_wind = (g + a) * wind;
  point.boresight_wind =
      structure.boresight_per_bull_gear * point.encoder_wind + structure.boresight_per_wind;
  return point;
}

PlantResponse plant_response(const StructureResponse& structure, const Drive& drive) {
  const Eigen::Index count = structure.frequency.size();
  PlantResponse response = unset_response(structure.frequency);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ResponsePoint point =
        drive_on_structure(drive,
                           {structure.inertial_stiffness[i], structure.gear_stiffness[i],
                            structure.wind_at_bull_gear[i], structure.boresight_per_bull_gear[i],
                            structure.boresight_per_wind[i]},
                           structure.frequency[i]);
    set_point(response, i, point);
  }
  return response;
}

PlantResponse plant_response(const AntennaPlant& plant, const Eigen::ArrayXd& frequency) {
  return plant_response(structure_response(plant.structure, frequency), plant.drive);
}

Eigen::ArrayXd frequency_grid(const AntennaPlant& plant, double lowest, double highest,
                              int points_per_decade) {
  if (!(lowest > 0.0) || !(highest > lowest) || points_per_decade < 1) {
    throw InvalidInput(
        fmt::format("frequency_grid: expected 0 < lowest < highest and at least 1 point a decade, "
                    "found {} Hz, {} Hz, {}",
                    lowest, highest, points_per_decade));
  }
  const double decades = std::log10(highest / lowest);
  const int intervals = static_cast<int>(std::ceil(decades * points_per_decade));
  std::vector<double> points;
  for (int i = 0; i <= intervals; ++i) {
    points.push_back(two_pi * lowest * std::pow(10.0, decades * i / intervals));
  }
  const Eigen::VectorXcd poles = numerics::eigenvalues(to_state_space(plant).a);
  for (const std::complex<double> pole : poles) {
    const double half_width = -pole.real();
    if (pole.imag() <= 0.0 || half_width > 0.1 * std::abs(pole)) continue;
    for (int k = -12; k <= 12; ++k) {
      const double w = pole.imag() + 4.0 * half_width * k / 12.0;
      if (w > points.front() && w < two_pi * highest) points.push_back(w);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(),
                           [](double x, double y) { return y - x < 1e-9 * x; }),
               points.end());
  return Eigen::Map<Eigen::ArrayXd>(points.data(), static_cast<Eigen::Index>(points.size()));
}

}  // namespace boresight::plant
