#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/audit/case_graph.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {
namespace {

using design::AuditNode;
using design::PrintedForm;
using design::Statement;
using Arguments = std::span<const double>;

PrintedForm printed_form(const std::string& text, double value, double half_unit, Kind kind) {
  return {text, value, half_unit, static_cast<int>(column_of(text, kind))};
}

Statement statement_of(const Quantity& quantity) {
  Statement statement;
  statement.source = quantity.source;
  statement.forms.push_back(
      printed_form(quantity.text, quantity.value, quantity.half_unit, quantity.kind));
  for (const PrintedNumber& other : quantity.also) {
    statement.forms.push_back(
        printed_form(other.text, other.value, other.half_unit, quantity.kind));
  }
  return statement;
}

class GraphBuilder {
 public:
  explicit GraphBuilder(const Case& antenna) : case_(antenna) {}

  design::AuditGraph build() {
    add_parts_and_assemblies();
    add_gear_train();
    add_flywheel_disk();
    add_reflected_inertia();
    add_oil();
    add_tests();
    for (const BandEntry& band : case_.bands) {
      input(fmt::format("band.{}.frequency", band.name), band.name + "-band frequency",
            band.frequency);
    }
    for (const StatedEntry& stated : case_.stated) {
      const auto node = std::find_if(nodes_.begin(), nodes_.end(), [&](const AuditNode& known) {
        return known.id == stated.quantity;
      });
      // A quantity the case states but gives too little to recompute is left out.
      if (node != nodes_.end()) node->statements.push_back(statement_of(stated.value));
    }
    return design::AuditGraph(std::move(nodes_));
  }

 private:
  void input(const std::string& id, const std::string& description, const Quantity& quantity) {
    nodes_.push_back({id,
                      description,
                      std::string(describe(quantity.kind).si_unit),
                      {},
                      {},
                      {statement_of(quantity)},
                      false});
  }

  void exact_input(const std::string& id, const std::string& description,
                   const Quantity& quantity) {
    input(id, description, quantity);
    nodes_.back().statements.front().forms.front().half_unit = 0.0;
  }

  AuditNode& derived(const std::string& id, const std::string& description, Kind kind,
                     std::vector<std::string> parents, std::function<double(Arguments)> formula,
                     bool headline = false) {
    nodes_.push_back({id,
                      description,
                      std::string(describe(kind).si_unit),
                      std::move(parents),
                      std::move(formula),
                      {},
                      headline});
    return nodes_.back();
  }

  static double sum(Arguments values) { return std::accumulate(values.begin(), values.end(), 0.0); }
  static double solid_disk(Arguments disk) {
    return plant::disk_inertia(disk[0], disk[1], disk[2]);
  }

  void add_parts_and_assemblies() {
    if (case_.gear_train->density) {
      input("gear_train.density", "density of the gear train", *case_.gear_train->density);
    }
    for (const RotatingAssembly& assembly : case_.gear_train->assemblies) {
      std::vector<std::string> parts;
      for (const AssemblyPart& part : assembly.parts) {
        parts.push_back(add_part(assembly, part));
      }
      const std::string id = "assembly." + assembly.name + ".inertia";
      const std::string description = "inertia of " + assembly.name;
      if (parts.empty()) {
        if (assembly.inertia) input(id, description, *assembly.inertia);
        continue;
      }
      AuditNode& node = derived(id, description + ", sum of its parts", Kind::inertia, parts, sum);
      if (assembly.inertia) node.statements.push_back(statement_of(*assembly.inertia));
    }
  }

  std::string add_part(const RotatingAssembly& assembly, const AssemblyPart& part) {
    const std::string name = "part." + part.name;
    const std::string what = part.name + " (" + assembly.name +
                             (part.description.empty() ? "" : ", " + part.description) + ")";
    if (!part.radius || !part.length) {
      if (part.inertia) input(name + ".inertia", "inertia of " + what, *part.inertia);
      return name + ".inertia";
    }
    input(name + ".radius", "radius of " + what, *part.radius);
    input(name + ".length", "length of " + what, *part.length);
    AuditNode& node =
        derived(name + ".inertia", "inertia of " + what + ", a solid disk", Kind::inertia,
                {name + ".radius", name + ".length", "gear_train.density"}, solid_disk);
    if (part.inertia) node.statements.push_back(statement_of(*part.inertia));
    return name + ".inertia";
  }

  std::string ratio_id(std::size_t stages) const {
    return stages == case_.gear_train->stages.size() ? "gear_ratio"
                                                     : fmt::format("gear_ratio.{}", stages);
  }

  void add_gear_train() {
    const auto& stages = case_.gear_train->stages;
    std::vector<std::string> teeth;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const std::string stage = fmt::format("gear_train.stage[{}]", i);
      exact_input(stage + ".driven_teeth", "driven teeth", stages[i].driven_teeth);
      exact_input(stage + ".driving_teeth", "driving teeth", stages[i].driving_teeth);
      teeth.push_back(stage + ".driven_teeth");
      teeth.push_back(stage + ".driving_teeth");
      derived(ratio_id(i + 1), fmt::format("ratio of the first {} stages", i + 1), Kind::number,
              teeth, [](Arguments counts) {
                std::vector<plant::GearStage> train;
                for (std::size_t k = 0; k + 1 < counts.size(); k += 2) {
                  train.push_back({counts[k], counts[k + 1]});
                }
                return plant::gear_ratio(train);
              });
    }
  }

  void add_flywheel_disk() {
    const MotorEntry& motor = *case_.motor;
    if (!motor.disk_radius || !motor.disk_length || !motor.disk_density) return;
    input("motor.disk_radius", "radius of a flywheel disk", *motor.disk_radius);
    input("motor.disk_length", "length of a flywheel disk", *motor.disk_length);
    input("motor.disk_density", "density of the flywheel disks", *motor.disk_density);
    AuditNode& node =
        derived("motor.disk_inertia", "inertia of a flywheel disk, a solid disk", Kind::inertia,
                {"motor.disk_radius", "motor.disk_length", "motor.disk_density"}, solid_disk);
    if (motor.disk_inertia_stated) node.statements.push_back(statement_of(motor.disk_inertia));
  }

  void add_reflected_inertia() {
    std::vector<std::string> loads;
    std::vector<std::string> one_train{"motor.inertia"};
    std::vector<double> fractions{1.0};
    for (const RotatingAssembly& assembly : case_.gear_train->assemblies) {
      const auto count = static_cast<double>(assembly.count);
      std::vector<std::string> parents{"assembly." + assembly.name + ".inertia"};
      if (assembly.stages > 0) parents.push_back(ratio_id(assembly.stages));
      loads.push_back("load_inertia." + assembly.name);
      derived(loads.back(), "inertia of all " + assembly.name + " at the motor", Kind::inertia,
              parents, [count](Arguments body) {
                return plant::reflected_inertia(body[0], body.size() > 1 ? body[1] : 1.0, count);
              });
      one_train.push_back(loads.back());
      fractions.push_back(1.0 / count);
    }
    input("antenna.inertia", "inertia about the antenna's axis", case_.antenna->inertia);
    loads.emplace_back("load_inertia.antenna");
    derived(loads.back(), "antenna inertia at the motor", Kind::inertia,
            {"antenna.inertia", "gear_ratio"},
            [](Arguments body) { return plant::reflected_inertia(body[0], body[1]); });
    derived("load_inertia", "load inertia at the motor", Kind::inertia, loads, sum, true);

    const auto motors = static_cast<double>(case_.motor->count);
    input("motor.inertia", "inertia of one motor with its flywheel", case_.motor->inertia);
    derived("motor_inertia", "inertia of all motors", Kind::inertia, {"motor.inertia"},
            [motors](Arguments motor) { return motors * motor[0]; });
    derived("reflected_inertia", "inertia felt at the motor", Kind::inertia,
            {"motor_inertia", "load_inertia"}, sum, true);
    derived(
        "motor_to_load_ratio", "motor-to-load inertia ratio", Kind::number,
        {"motor_inertia", "load_inertia"},
        [](Arguments inertia) {
          return plant::motor_to_load_ratio(inertia[0], inertia[0] + inertia[1]);
        },
        true);
    one_train.emplace_back("load_inertia.antenna");
    fractions.push_back(1.0);
    derived("reflected_inertia.one_train", "inertia of one motor, one gear train and the antenna",
            Kind::inertia, one_train, [fractions](Arguments inertia) {
              return std::inner_product(inertia.begin(), inertia.end(), fractions.begin(), 0.0);
            });
  }

  void add_oil() {
    const OilEntry& oil = *case_.oil;
    if (oil.density) input("oil.density", "density of the oil", *oil.density);
    std::vector<std::string> moduli;
    for (const OilLine& line : oil.lines) {
      const std::string name = "line." + line.name;
      input(name + ".length", "length of the " + line.name + " line", line.length);
      input(name + ".slosh_frequency", "slosh frequency of the " + line.name + " line",
            line.slosh_frequency);
      moduli.push_back(name + ".bulk_modulus");
      derived(moduli.back(), "bulk modulus from the " + line.name + " line", Kind::pressure,
              {name + ".length", name + ".slosh_frequency", "oil.density"}, [](Arguments wave) {
                return plant::bulk_modulus_from_slosh(wave[0], wave[1], wave[2]);
              });
    }
    if (moduli.empty()) {
      if (oil.bulk_modulus) input("bulk_modulus", "bulk modulus of the oil", *oil.bulk_modulus);
    } else {
      AuditNode& node = derived(
          "bulk_modulus", "bulk modulus, mean of the lines", Kind::pressure, moduli,
          [](Arguments values) { return sum(values) / static_cast<double>(values.size()); });
      if (oil.bulk_modulus) node.statements.push_back(statement_of(*oil.bulk_modulus));
    }
    input("motor.displacement", "displacement of one motor", case_.motor->displacement);
    input("motor.torque_efficiency", "torque efficiency", case_.motor->torque_efficiency);
    input("motor.volumetric_efficiency", "volumetric efficiency",
          case_.motor->volumetric_efficiency);
    input("oil.volume_1", "oil volume V1", oil.volume_1);
    input("oil.volume_2", "oil volume V2", oil.volume_2);
    plant::HydraulicDrive drive;
    drive.motor_count = static_cast<double>(case_.motor->count);
    drive.efficiency_in_stiffness = oil.efficiency_in_stiffness
                                        ? plant::EfficiencyInStiffness::both
                                        : plant::EfficiencyInStiffness::none;
    derived(
        "oil_stiffness", "oil spring at the motor", Kind::stiffness,
        {"motor.displacement", "motor.torque_efficiency", "motor.volumetric_efficiency",
         "bulk_modulus", "oil.volume_1", "oil.volume_2"},
        [drive](Arguments values) {
          plant::HydraulicDrive filled = drive;
          filled.displacement = values[0];
          filled.torque_efficiency = values[1];
          filled.volumetric_efficiency = values[2];
          filled.bulk_modulus = values[3];
          filled.volume_1 = values[4];
          filled.volume_2 = values[5];
          return plant::oil_stiffness(filled);
        },
        true);
  }

  void add_ratio_to_motors(const std::string& method) {
    derived(
        method + ".motor_to_load_ratio", "motor-to-load inertia ratio by " + method, Kind::number,
        {"motor_inertia", method + ".reflected_inertia"},
        [](Arguments inertia) { return plant::motor_to_load_ratio(inertia[0], inertia[1]); }, true);
  }

  void add_tests() {
    if (case_.resonance->frequency) {
      input("resonance.frequency", "hydraulic resonance", *case_.resonance->frequency);
      derived(
          "resonance.reflected_inertia", "inertia from the hydraulic resonance", Kind::inertia,
          {"oil_stiffness", "resonance.frequency"},
          [](Arguments spring) { return plant::inertia_from_resonance(spring[0], spring[1]); },
          true);
      add_ratio_to_motors("resonance");
    }
    for (const ImpulseResult& result : case_.impulse_results) {
      const std::string method = "impulse." + result.name;
      input(method + ".reflected_inertia", "inertia from impulse and momentum, " + result.name,
            result.reflected_inertia);
      add_ratio_to_motors(method);
    }
    if (case_.tachometer) add_tachometer(*case_.tachometer);
    const auto& [coulomb, slope, up, down] = *case_.friction_tests;
    if (!up || !down) return;
    input("friction.slow_ramp.up", "friction and offset, upward slow ramp", *up);
    input("friction.slow_ramp.down", "friction and offset, downward slow ramp", *down);
    const std::vector<std::string> ramps{"friction.slow_ramp.up", "friction.slow_ramp.down"};
    derived("friction.slow_ramp.coulomb", "Coulomb friction by the slow ramp", Kind::torque, ramps,
            [](Arguments torque) { return 0.5 * (torque[0] + torque[1]); });
    derived("friction.slow_ramp.offset", "offset torque by the slow ramp", Kind::torque, ramps,
            [](Arguments torque) { return 0.5 * std::abs(torque[0] - torque[1]); });
  }

  void add_tachometer(const TachometerEntry& tachometer) {
    input("tachometer.voltage", "tachometer voltage", tachometer.voltage);
    input("tachometer.shaft_speed", "tachometer speed at that voltage", tachometer.shaft_speed);
    exact_input("tachometer.motor_teeth", "motor turns per", tachometer.motor_teeth);
    exact_input("tachometer.tachometer_teeth", "tachometer turns", tachometer.tachometer_teeth);
    derived("tachometer.scale", "motor rate per tachometer volt", Kind::tachometer_scale,
            {"tachometer.shaft_speed", "tachometer.voltage", "tachometer.motor_teeth",
             "tachometer.tachometer_teeth"},
            [](Arguments values) { return values[0] / values[1] * values[2] / values[3]; });
  }

  const Case& case_;
  std::vector<AuditNode> nodes_;
};

}  // namespace

UnitColumn column_of(const std::string& text, Kind kind) {
  static constexpr std::array names{"in",  "ft",  "yd",  "mile", "lbf", "lbm", "slug",
                                    "psi", "ksi", "kip", "hp",   "ozf", "ozm"};
  std::string name;
  for (const char character : text + " ") {
    if (std::isalpha(static_cast<unsigned char>(character)) != 0 || character == '_') {
      name += character;
      continue;
    }
    if (std::find(names.begin(), names.end(), name) != names.end() || name.starts_with("US_")) {
      return UnitColumn::inch_pound;
    }
    name.clear();
  }
  static constexpr std::array shared{
      Kind::number,       Kind::time,    Kind::angle,         Kind::frequency,
      Kind::angular_rate, Kind::voltage, Kind::rate_constant, Kind::tachometer_scale};
  return std::find(shared.begin(), shared.end(), kind) != shared.end() ? UnitColumn::either
                                                                       : UnitColumn::metric;
}

design::AuditGraph case_graph(const Case& antenna) {
  return GraphBuilder(antenna).build();
}

}  // namespace boresight::io
