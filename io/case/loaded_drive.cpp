#include <cmath>

#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/loaded_drive.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::io {

LoadedDrive::LoadedDrive(const Case& antenna, double oil_stiffness, double supply_torque)
    : curve_(friction_curve(antenna)),
      offset_(std::abs(plant::offset_torque(offset_torque(antenna), 0.0).value)),
      leakage_(antenna.drive.leakage_rate.value / oil_stiffness) {
  const auto& back =
      antenna.simulation ? antenna.simulation->return_pressure : antenna.campaign.return_pressure;
  const double share = back ? back->value / antenna.drive.supply_pressure.value : 0.0;
  available_ = supply_torque * (1.0 - share);
}

double LoadedDrive::load(double rate) const {
  return plant::friction_torque(curve_, rate) + offset_;
}

double LoadedDrive::excess(double rate, double stroke) const {
  const double torque = load(rate);
  const double share = (rate + leakage_ * torque) / stroke;
  return torque - available_ * (1.0 - share * share);
}

double LoadedDrive::attainable_rate(double stroke) const {
  double lowest = 0.0, highest = stroke;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (lowest + highest);
    (excess(middle, stroke) <= 0.0 ? lowest : highest) = middle;
  }
  return lowest;
}

std::optional<double> slew_rate_margin(const Case& antenna) {
  if (!antenna.simulation && !rated_stroke(antenna)) return std::nullopt;
  const LoadedDrive drive(antenna, oil_stiffness(antenna), supply_torque(antenna));
  return drive.attainable_rate(largest_demand(antenna)) /
         (antenna.drive.slew_rate.value * gear_ratio(antenna));
}

}  // namespace boresight::io
