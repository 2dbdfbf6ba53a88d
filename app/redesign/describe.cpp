#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <boresight/app/redesign/sections.hpp>
#include <boresight/plant/plant_response.hpp>

namespace boresight::app {
namespace {

std::string printed(const Case& antenna, const std::string& id) {
  for (const auto& stated : antenna.stated) {
    if (stated.quantity == id) return stated.value.text;
  }
  return {};
}

// Tachometer scale, friction and offset: small results with inputs of their own.
void identify_sensors(const Case& antenna, const StudyOptions& options,
                      IdentificationSection& section) {
  using Point = std::span<const double>;
  const auto input = [](const Quantity& quantity) {
    return identification::UncertainInput{quantity.key, quantity.value,
                                          quantity.standard_uncertainty};
  };
  const identification::PropagationOptions draws{20000, options.seed};
  if (antenna.tachometer) {
    const TachometerEntry& tachometer = *antenna.tachometer;
    section.tachometer_scale =
        identification::propagate(
            {input(tachometer.shaft_speed), input(tachometer.voltage)},
            {{"tachometer scale",
              [turns = tachometer.motor_teeth.value / tachometer.tachometer_teeth.value](Point x) {
                return identification::tachometer_scale(x[0], x[1], turns);
              }}},
            draws)
            .front();
  }
  const FrictionTestsEntry& tests = antenna.friction_tests;
  if (tests.slow_ramp_up && tests.slow_ramp_down) {
    const auto results = identification::propagate(
        {input(*tests.slow_ramp_up), input(*tests.slow_ramp_down)},
        {{"Coulomb friction, slow ramp",
          [](Point x) { return identification::friction_and_offset(x[0], x[1]).coulomb; }},
         {"offset torque, slow ramp",
          [](Point x) { return identification::friction_and_offset(x[0], x[1]).offset; }}},
        draws);
    section.slow_ramp_coulomb = results[0];
    section.slow_ramp_offset = results[1];
  }
}

}  // namespace

IdentificationSection identify(const Case& antenna, const StudyOptions& options) {
  IdentificationSection section;
  section.inertia = identification::identify_inertia(make_evidence(antenna), {20000, options.seed});

  // In the order in which identify_inertia lists the methods.
  section.printed.push_back(
      {printed(antenna, "reflected_inertia"), printed(antenna, "motor_to_load_ratio")});
  for (std::size_t i = 0; i < antenna.antenna.alternatives.size(); ++i) {
    section.printed.push_back(section.printed.front());
  }
  // The printed total rests on the antenna inertia that reproduces it.
  const auto& methods = section.inertia.methods;
  const auto stated =
      std::find_if(antenna.stated.begin(), antenna.stated.end(),
                   [](const StatedEntry& entry) { return entry.quantity == "reflected_inertia"; });
  if (stated != antenna.stated.end()) {
    std::size_t nearest = 0;
    const auto distance = [&](std::size_t i) {
      return std::abs(methods[i].reflected_inertia.value - stated->value.value);
    };
    for (std::size_t i = 1; i < section.printed.size(); ++i) {
      if (distance(i) < distance(nearest)) nearest = i;
    }
    for (std::size_t i = 0; i < section.printed.size(); ++i) {
      if (i != nearest) section.printed[i] = {};
    }
  }
  if (antenna.resonance_frequency) {
    section.printed.push_back({printed(antenna, "resonance.reflected_inertia"),
                               printed(antenna, "resonance.motor_to_load_ratio")});
  }
  for (const auto& impulse : antenna.impulse_results) {
    section.printed.push_back(
        {impulse.reflected_inertia.text,
         printed(antenna, "impulse." + impulse.name + ".motor_to_load_ratio")});
  }

  // One estimate a method: the first mass properties, the resonance, the impulses' mean.
  std::vector<identification::Uncertain> estimates;
  const auto estimate = [](const identification::PropagatedResult& result) {
    return identification::Uncertain{result.value, result.standard_uncertainty};
  };
  estimates.push_back(estimate(methods.front().reflected_inertia));
  std::size_t next = 1 + antenna.antenna.alternatives.size();
  if (antenna.resonance_frequency) estimates.push_back(estimate(methods[next++].reflected_inertia));
  if (next < methods.size()) {
    const auto count = static_cast<double>(methods.size() - next);
    double mean = 0.0, own = 0.0, spread = 0.0;
    for (std::size_t i = next; i < methods.size(); ++i) {
      mean += methods[i].reflected_inertia.value / count;
      own += methods[i].reflected_inertia.standard_uncertainty / count;
    }
    for (std::size_t i = next; i < methods.size(); ++i) {
      spread = std::max(spread, std::abs(methods[i].reflected_inertia.value - mean));
    }
    // One record with several friction values: their spread is a systematic error.
    estimates.push_back({mean, std::hypot(own, spread)});
  }
  if (estimates.size() > 1) {
    section.reconciled =
        identification::reconcile(estimates, motor_inertia(antenna, antenna.motor.flywheel_disks));
  }
  identify_sensors(antenna, options, section);
  return section;
}

PlantSection describe_plant(const Case& antenna) {
  PlantSection section;
  section.plant = make_plant(antenna);
  section.gear_ratio = gear_ratio(antenna);
  section.reflected_inertia = plant::reflected_inertia(section.plant);
  section.motor_to_load_ratio = plant::motor_to_load_ratio(
      motor_inertia(antenna, antenna.motor.flywheel_disks), section.reflected_inertia);
  section.rigid_frequency =
      plant::hydraulic_frequency(section.plant.drive.oil_stiffness, section.reflected_inertia);
  section.tracking_friction = tracking_friction(antenna);
  section.modes = plant::plant_modes(section.plant);
  section.hydraulic = plant::hydraulic_mode(section.modes);
  const MotorEntry& motor = antenna.motor;
  section.supply_torque = antenna.drive.supply_pressure.value * motor.torque_efficiency.value *
                          static_cast<double>(motor.count) * motor.displacement.value;
  const auto problem = make_problem(antenna);
  section.mean_wind_torque =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / section.gear_ratio;
  return section;
}

std::vector<Quantity> assumed_inputs(const Case& antenna) {
  std::vector<Quantity> assumed;
  for (const auto& quantity : antenna.quantities) {
    if (quantity.basis == Basis::assumed || quantity.uncertainty_source.starts_with("assumed")) {
      assumed.push_back(quantity);
    }
  }
  return assumed;
}

}  // namespace boresight::app
