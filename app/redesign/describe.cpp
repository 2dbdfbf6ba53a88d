#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <boresight/app/redesign/sections.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::app {
namespace {

std::string printed(const io::Case& antenna, const std::string& id) {
  for (const auto& stated : antenna.stated) {
    if (stated.quantity == id) return stated.value.text;
  }
  return {};
}

// Tachometer scale, friction and offset: small results with inputs of their own.
void identify_sensors(const io::Case& antenna, const StudyOptions& options,
                      IdentificationSection& section) {
  using Point = std::span<const double>;
  const auto input = [](const io::Quantity& quantity) {
    return numerics::UncertainInput{quantity.key, quantity.value, quantity.standard_uncertainty};
  };
  const numerics::PropagationOptions random_samples{20000, options.seed};
  if (antenna.tachometer) {
    const io::TachometerEntry& tachometer = *antenna.tachometer;
    section.tachometer_scale =
        numerics::propagate(
            {input(tachometer.shaft_speed), input(tachometer.voltage)},
            {{"tachometer scale",
              [turns = tachometer.motor_teeth.value / tachometer.tachometer_teeth.value](Point x) {
                return identification::tachometer_scale(x[0], x[1], turns);
              }}},
            random_samples)
            .front();
  }
  const io::FrictionTestsEntry& tests = *antenna.friction_tests;
  if (tests.slow_ramp_up && tests.slow_ramp_down) {
    const auto results = numerics::propagate(
        {input(*tests.slow_ramp_up), input(*tests.slow_ramp_down)},
        {{"Coulomb friction, slow ramp",
          [](Point x) { return identification::friction_and_offset(x[0], x[1]).coulomb; }},
         {"offset torque, slow ramp",
          [](Point x) { return identification::friction_and_offset(x[0], x[1]).offset; }}},
        random_samples);
    section.slow_ramp_coulomb = results[0];
    section.slow_ramp_offset = results[1];
  }
}

// What the case prints for each method. A printed total belongs to the printed load it sums, or to
// the first mass properties.
std::vector<IdentificationSection::Printed> printed_beside(
    const io::Case& antenna, const std::vector<identification::InertiaMethod>& methods) {
  using identification::MethodKind;
  std::vector<IdentificationSection::Printed> beside(methods.size());
  const bool load = !printed(antenna, "load_inertia").empty();
  std::size_t mass = 0;
  auto impulse = antenna.impulse_results.begin();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    switch (methods[i].kind) {
      case MethodKind::mass_properties:
        if (load) mass = i;
        break;
      case MethodKind::resonance:
        beside[i] = {printed(antenna, "resonance.reflected_inertia"),
                     printed(antenna, "resonance.motor_to_load_ratio")};
        break;
      case MethodKind::impulse:
        beside[i] = {impulse->reflected_inertia.text,
                     printed(antenna, "impulse." + impulse->name + ".motor_to_load_ratio")};
        ++impulse;
        break;
    }
  }
  beside[mass] = {printed(antenna, "reflected_inertia"), printed(antenna, "motor_to_load_ratio")};
  return beside;
}

// One estimate a kind: the first mass properties, the resonance, the impulses' mean.
std::vector<numerics::Uncertain> independent_estimates(
    const std::vector<identification::InertiaMethod>& methods) {
  using identification::MethodKind;
  std::vector<numerics::Uncertain> estimates;
  std::vector<numerics::Uncertain> impulses;
  for (const auto& method : methods) {
    const numerics::Uncertain estimate{method.reflected_inertia.value,
                                       method.reflected_inertia.standard_uncertainty};
    if (method.kind == MethodKind::impulse) {
      impulses.push_back(estimate);
    } else if (method.kind == MethodKind::resonance || estimates.empty()) {
      estimates.push_back(estimate);
    }
  }
  if (impulses.empty()) return estimates;
  double mean = 0.0, own = 0.0, spread = 0.0;
  for (const auto& impulse : impulses) {
    mean += impulse.value / static_cast<double>(impulses.size());
    own += impulse.standard_uncertainty / static_cast<double>(impulses.size());
  }
  for (const auto& impulse : impulses) spread = std::max(spread, std::abs(impulse.value - mean));
  // One record with several friction values: their spread is a systematic error.
  estimates.push_back({mean, std::hypot(own, spread)});
  return estimates;
}

// What the mass properties take from the case.
std::string stated_masses(const io::Case& antenna) {
  const auto solid = [](const io::RotatingAssembly& assembly) {
    return !assembly.inertia &&
           std::ranges::any_of(assembly.parts, [](const io::AssemblyPart& part) {
             return !part.inertia.has_value();
           });
  };
  std::string text = "the case's inertias of motors and antenna";
  if (std::ranges::any_of(antenna.gear_train->assemblies, solid)) {
    text += ", solid disks for gears of which it gives the size";
  }
  return text;
}

}  // namespace

IdentificationSection identify(const io::Case& antenna, const StudyOptions& options) {
  IdentificationSection section;
  section.inertia = identification::identify_inertia(make_evidence(antenna), {20000, options.seed});

  const auto& methods = section.inertia.methods;
  section.printed = printed_beside(antenna, methods);
  section.pounds_force = std::ranges::any_of(antenna.quantities, [](const io::Quantity& quantity) {
    const auto in_pounds = [](const std::string& text) {
      return text.find("lbf") != std::string::npos;
    };
    return quantity.kind == io::Kind::inertia &&
           (in_pounds(quantity.text) ||
            std::ranges::any_of(quantity.also, [&](const io::PrintedNumber& number) {
              return in_pounds(number.text);
            }));
  });
  for (auto& method : section.inertia.methods) {
    if (method.kind == identification::MethodKind::mass_properties &&
        method.name.starts_with("mass properties, antenna from ")) {
      method.assumes = stated_masses(antenna);
    }
  }
  const auto estimates = independent_estimates(methods);
  if (estimates.size() > 1) {
    section.combined =
        identification::combine(estimates, motor_inertia(antenna, antenna.motor->flywheel_disks));
  }
  identify_sensors(antenna, options, section);
  return section;
}

PlantSection describe_plant(const io::Case& antenna) {
  PlantSection section;
  section.plant = make_plant(antenna);
  section.gear_ratio = io::gear_ratio(antenna);
  section.reflected_inertia = plant::reflected_inertia(section.plant);
  section.motor_to_load_ratio = plant::motor_to_load_ratio(
      motor_inertia(antenna, antenna.motor->flywheel_disks), section.reflected_inertia);
  section.rigid_frequency =
      plant::hydraulic_frequency(section.plant.drive.oil_stiffness, section.reflected_inertia);
  section.tracking_slope = io::tracking_slope(antenna);
  section.friction = io::friction_curve(antenna);
  for (const auto& test : antenna.friction_curve->tests) {
    section.friction_tests.push_back({{test.rate, test.torque, test.leeway}, test.residual});
  }
  section.modes = plant::plant_modes(section.plant);
  section.motors_held = antenna.structure->motors_held;
  section.hydraulic = plant::hydraulic_mode(section.modes);
  section.supply_torque = io::supply_torque(antenna);
  section.available_wind_torque = io::available_wind_torque(antenna);
  const auto problem = make_problem(antenna);
  section.mean_wind_torque =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / section.gear_ratio;
  section.slew_rate_margin = plant::slew_rate_margin(drive_of(antenna));
  return section;
}

}  // namespace boresight::app
