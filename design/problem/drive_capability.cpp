#include <algorithm>
#include <cmath>

#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/friction.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::design {

double attainable_rate(const plant::NonlinearAntenna& antenna, double wanted) {
  const auto holds = [&](double rate) {
    try {
      plant::trim(antenna, {rate, 0.0, {}});
      plant::trim(antenna, {-rate, 0.0, {}});
      return true;
    } catch (const NumericalFailure&) {
      return false;
    }
  };
  if (holds(wanted)) return wanted;
  double lowest = 0.0, highest = wanted;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (lowest + highest);
    (holds(middle) ? lowest : highest) = middle;
  }
  return lowest;
}

control::CommandLimits achievable_limits(const plant::NonlinearAntenna& antenna, double inertia,
                                         const control::CommandLimits& wanted) {
  const double attainable = attainable_rate(antenna, wanted.rate);
  const double rate = attainable < wanted.rate ? 0.8 * attainable : wanted.rate;
  const auto& valve = antenna.valve;
  const double fraction = rate / (valve.stroke_limit - valve.overlap);
  const double available =
      (antenna.oil.supply_torque - antenna.oil.return_torque) * (1.0 - fraction * fraction);
  const double needed = plant::friction_torque(antenna.friction.curve, rate) +
                        std::abs(plant::offset_torque(antenna.offset, 0.0).value);
  return {rate, std::min(wanted.acceleration, 0.5 * (available - needed) / inertia)};
}

}  // namespace boresight::design
