#include <cmath>
#include <complex>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/inertia_update.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

void check(double motor_inertia) {
  if (!(motor_inertia > 0.0) || !std::isfinite(motor_inertia)) {
    throw InvalidInput(
        fmt::format("with_motor_inertia: expected a positive, finite motor_inertia (kg m2), found "
                    "{}",
                    motor_inertia));
  }
}

ResponsePoint update(const ResponsePoint& response, const Drive& drive, double motor_inertia,
                     double frequency) {
  const Complex s{0.0, frequency};
  const double wv = drive.valve_corner;
  const Complex valve = wv * wv / (s * s + 2.0 * drive.valve_damping * wv * s + wv * wv);
  const Complex oil = drive.oil_stiffness / (s + drive.leakage_rate);
  const Complex tachometer = s * drive.tachometer_corner / (s + drive.tachometer_corner);
  const Complex torque = oil * valve;  // of the motors held, per command

  const Complex angle_command = response.tachometer_command / tachometer;
  const Complex angle_wind = response.tachometer_wind / tachometer;
  const Complex change = (motor_inertia - drive.motor_inertia) * s * s;
  const Complex kept = 1.0 / (1.0 + change * angle_command / torque);
  const Complex pull = change * kept / torque;
  const Complex lost = angle_command * pull;  // share of the motors' motion: 1 - kept

  ResponsePoint updated;
  updated.tachometer_command = response.tachometer_command * kept;
  updated.encoder_command = response.encoder_command * kept;
  updated.beam_command = response.beam_command * kept;
  // Torque is what the oil makes of valve less motion: the motion lost is added to it.
  updated.torque_command = response.torque_command + oil * s * angle_command * lost;
  updated.tachometer_wind = response.tachometer_wind * kept;
  updated.torque_wind = response.torque_wind * kept;
  updated.encoder_wind = response.encoder_wind - response.encoder_command * pull * angle_wind;
  updated.beam_wind = response.beam_wind - response.beam_command * pull * angle_wind;
  return updated;
}

}  // namespace

ResponsePoint with_motor_inertia(const ResponsePoint& response, const Drive& drive,
                                 double motor_inertia, double frequency) {
  check(motor_inertia);
  return update(response, drive, motor_inertia, frequency);
}

PlantResponse with_motor_inertia(PlantResponse response, const Drive& drive, double motor_inertia) {
  check(motor_inertia);
  for (Eigen::Index i = 0; i < response.frequency.size(); ++i) {
    set_point(response, i, update(point(response, i), drive, motor_inertia, response.frequency[i]));
  }
  return response;
}

}  // namespace boresight::plant
