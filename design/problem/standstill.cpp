#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boresight/design/problem/standstill.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::design {
namespace {

// rad
double step_of_motor(const plant::Antenna& antenna) {
  return sky_to_motor(antenna, encoder_step(antenna));
}

// Hz
double hydraulic_frequency(const plant::Antenna& antenna) {
  return plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna))).frequency;
}

// Of the motion at standstill, rad/s.
constexpr double sixth = 1.0 / 6.0;
double standstill_frequency(const plant::Antenna& antenna) {
  return sixth * two_pi * hydraulic_frequency(antenna);
}

// Amplitude at an edge over the encoder's step; frequencies over the hydraulic mode's.
constexpr double edge_amplitude = 0.25;
constexpr std::array<double, 4> edge_frequencies{0.27, 0.45, 0.8, 1.35};

}  // namespace

double encoder_step(double noise) {
  return std::sqrt(12.0) * noise;
}

double encoder_step(const plant::Antenna& antenna) {
  return encoder_step(antenna.sensors.encoder_noise);
}

std::vector<double> standstill_friction(const plant::Antenna& antenna) {
  const double step = step_of_motor(antenna);
  if (!(step > 0.0)) return {};
  const double rate = 0.5 * step * sixth * two_pi * hydraulic_frequency(antenna);
  const double friction = plant::equivalent_friction(antenna.friction_curve, rate);
  std::vector<double> slopes;
  for (const double part : {sixth, 2.0 * sixth, 1.0}) {
    if (part * friction > antenna.drive.viscous_friction) slopes.push_back(part * friction);
  }
  return slopes;
}

std::vector<double> standstill_amplitudes(const plant::Antenna& antenna) {
  const std::vector<double> slopes = standstill_friction(antenna);
  if (slopes.empty()) return {};
  const double smallest = 0.5 * step_of_motor(antenna);
  const double frequency = standstill_frequency(antenna);
  constexpr double most_times = 1e4;
  std::vector<double> amplitudes;
  for (const double slope : slopes) {
    const auto excess = [&](double log_amplitude) {
      const double rate = std::exp(log_amplitude) * frequency;
      return std::log(plant::equivalent_friction(antenna.friction_curve, rate) / slope);
    };
    const double low = std::log(smallest), high = std::log(most_times * smallest);
    const double at_low = excess(low), at_high = excess(high);
    amplitudes.push_back(
        at_low <= 0.0    ? smallest
        : at_high >= 0.0 ? most_times * smallest
                         : std::exp(numerics::bracketed_root(excess, low, high, at_low, at_high)));
  }
  return amplitudes;
}

std::vector<Standstill::Edge> encoder_edges(const plant::Antenna& antenna) {
  if (standstill_friction(antenna).empty()) return {};
  const double amplitude = edge_amplitude * step_of_motor(antenna);
  const double frequency = two_pi * hydraulic_frequency(antenna);
  std::vector<Standstill::Edge> edges;
  for (const double part : edge_frequencies) {
    edges.push_back(
        {plant::equivalent_friction(antenna.friction_curve, amplitude * part * frequency),
         2.0 / (std::numbers::pi * edge_amplitude)});
  }
  return edges;
}

std::optional<double> breakaway_stiffness(const plant::Antenna& antenna) {
  if (standstill_friction(antenna).empty()) return std::nullopt;
  const plant::FrictionCurve& curve = antenna.friction_curve;
  return std::max(curve.breakaway_torque, curve.coulomb_torque) / step_of_motor(antenna);
}

}  // namespace boresight::design
