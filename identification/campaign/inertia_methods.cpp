#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::identification {
namespace {

using Point = std::span<const double>;
using Formula = std::function<double(Point)>;

// Collects the inputs, and hands out each as a formula of the drawn point.
class Inputs {
 public:
  Formula add(const std::string& name, const numerics::Uncertain& number) {
    const std::size_t index = list_.size();
    list_.push_back({name, number.value, number.standard_uncertainty});
    return [index](Point point) { return point[index]; };
  }
  const std::vector<numerics::UncertainInput>& list() const { return list_; }

 private:
  std::vector<numerics::UncertainInput> list_;
};

class Targets {
 public:
  std::size_t add(const std::string& name, Formula formula, bool reciprocal = false) {
    list_.push_back({name, std::move(formula), reciprocal});
    return list_.size() - 1;
  }
  const std::vector<numerics::PropagationTarget>& list() const { return list_; }

 private:
  std::vector<numerics::PropagationTarget> list_;
};

Formula sum(std::vector<Formula> terms) {
  return [terms = std::move(terms)](Point point) {
    double total = 0.0;
    for (const auto& term : terms) total += term(point);
    return total;
  };
}

Formula mean_of(const std::vector<Formula>& terms) {
  return [total = sum(terms), count = static_cast<double>(terms.size())](Point point) {
    return total(point) / count;
  };
}

struct MethodTargets {
  MethodKind kind;
  std::string name;
  std::string assumes;
  std::size_t inertia, ratio, remainder;
};

}  // namespace

InertiaIdentification identify_inertia(const DriveEvidence& evidence,
                                       const numerics::PropagationOptions& options) {
  if (evidence.antenna.empty()) {
    throw InvalidInput("identify_inertia: expected at least one antenna inertia, found none");
  }
  Inputs inputs;
  Targets targets;
  InertiaIdentification result;
  result.gear_ratio = plant::gear_ratio(evidence.stages);

  const Formula one_motor = inputs.add("motor inertia", evidence.motor_inertia);
  const Formula motors = [one_motor, count = evidence.motor_count](Point point) {
    return count * one_motor(point);
  };
  std::vector<std::size_t> row_targets;
  std::vector<Formula> gear_rows;
  for (const auto& assembly : evidence.assemblies) {
    const double ratio = plant::gear_ratio(evidence.stages, assembly.stages);
    gear_rows.emplace_back([own = inputs.add(assembly.name, assembly.inertia), ratio,
                            count = assembly.count](Point point) {
      return plant::reflected_inertia(own(point), ratio, count);
    });
    row_targets.push_back(targets.add(assembly.name, gear_rows.back()));
  }
  const Formula gear_train = sum(gear_rows);

  std::vector<MethodTargets> methods;
  const auto add_method = [&](MethodKind kind, std::string name, std::string assumes,
                              const Formula& inertia) {
    const Formula load_to_motor = [inertia, motors](Point point) {
      return plant::load_to_motor_ratio(motors(point), inertia(point));
    };
    const Formula remainder = [inertia, motors, gear_train](Point point) {
      return inertia(point) - motors(point) - gear_train(point);
    };
    methods.push_back({kind, std::move(name), std::move(assumes),
                       targets.add("reflected inertia", inertia),
                       targets.add("motor-to-load ratio", load_to_motor, true),
                       targets.add("left for the antenna", remainder)});
  };

  Formula first_total, first_row;
  for (const auto& antenna : evidence.antenna) {
    const Formula row = inputs.add("antenna inertia, " + antenna.name, antenna.reflected);
    row_targets.push_back(targets.add("antenna, " + antenna.name, row));
    const Formula total = sum({motors, gear_train, row});
    if (!first_total) {
      first_total = total;
      first_row = row;
    }
    add_method(MethodKind::mass_properties, "mass properties, antenna from " + antenna.name,
               "solid disks, structural group's antenna inertia", total);
  }

  if (evidence.printed_load) {
    // A printed sum varies with the samples of its terms, so that it is as uncertain as they are.
    const Formula parts = sum({gear_train, first_row});
    double nominal = evidence.antenna.front().reflected.value;
    for (const auto& assembly : evidence.assemblies) {
      nominal += plant::reflected_inertia(assembly.inertia.value,
                                          plant::gear_ratio(evidence.stages, assembly.stages),
                                          assembly.count);
    }
    const double printed = evidence.printed_load->value;
    add_method(MethodKind::mass_properties,
               "mass properties, load inertia as printed in " + evidence.printed_load->source,
               "the source's own sum of the load",
               [=](Point point) { return motors(point) + printed * parts(point) / nominal; });
  }

  Formula density;
  if (!evidence.lines.empty()) density = inputs.add("oil density", evidence.oil_density);
  std::vector<Formula> line_moduli;
  std::vector<std::size_t> line_targets;
  for (const auto& line : evidence.lines) {
    line_moduli.emplace_back(
        [length = inputs.add("length of the " + line.name + " line", line.length),
         frequency =
             inputs.add("slosh frequency of the " + line.name + " line", line.slosh_frequency),
         density](Point point) {
          return plant::bulk_modulus_from_slosh(length(point), frequency(point), density(point));
        });
    line_targets.push_back(targets.add("bulk modulus, " + line.name + " line", line_moduli.back()));
  }
  const Formula bulk_modulus = evidence.bulk_modulus
                                   ? inputs.add("bulk modulus", *evidence.bulk_modulus)
                                   : mean_of(line_moduli);
  const std::size_t bulk_target = targets.add("bulk modulus", bulk_modulus);
  const Formula stiffness =
      [&, displacement = inputs.add("displacement", evidence.displacement),
       torque_efficiency = inputs.add("torque efficiency", evidence.torque_efficiency),
       volumetric_efficiency = inputs.add("volumetric efficiency", evidence.volumetric_efficiency),
       volume_1 = inputs.add("volume V1", evidence.volume_1),
       volume_2 = inputs.add("volume V2", evidence.volume_2), bulk_modulus](Point point) {
        return plant::oil_stiffness({evidence.motor_count, displacement(point),
                                     torque_efficiency(point), volumetric_efficiency(point),
                                     bulk_modulus(point), volume_1(point), volume_2(point),
                                     evidence.efficiency_in_stiffness});
      };
  const std::size_t stiffness_target = targets.add("oil stiffness", stiffness);
  const std::size_t frequency_target =
      targets.add("expected hydraulic frequency", [stiffness, first_total](Point point) {
        return plant::hydraulic_frequency(stiffness(point), first_total(point));
      });
  if (evidence.resonance_frequency) {
    const Formula frequency = inputs.add("resonance frequency", *evidence.resonance_frequency);
    add_method(MethodKind::resonance, "hydraulic resonance",
               "rigid, loss-free antenna on the oil spring", [stiffness, frequency](Point point) {
                 return plant::inertia_from_resonance(stiffness(point), frequency(point));
               });
  }
  for (const auto& impulse : evidence.impulse) {
    add_method(MethodKind::impulse, "impulse-momentum, " + impulse.name,
               "straight-line friction, rigid antenna",
               inputs.add("impulse-momentum, " + impulse.name, impulse.reflected_inertia));
  }

  const auto propagated = numerics::propagate(inputs.list(), targets.list(), options);
  for (const std::size_t row : row_targets) result.load_rows.push_back(propagated[row]);
  for (const std::size_t line : line_targets) result.line_bulk_modulus.push_back(propagated[line]);
  result.bulk_modulus = propagated[bulk_target];
  result.oil_stiffness = propagated[stiffness_target];
  result.expected_frequency = propagated[frequency_target];
  for (const auto& method : methods) {
    result.methods.push_back({method.kind, method.name, method.assumes, propagated[method.inertia],
                              propagated[method.ratio], propagated[method.remainder]});
  }
  return result;
}

bool CombinedInertia::contradictory() const {
  return heterogeneity > numerics::chi_squared_quantile(0.999, degrees_of_freedom);
}

CombinedInertia combine(const std::vector<numerics::Uncertain>& estimates, double motor_inertia) {
  if (estimates.size() < 2) {
    throw InvalidInput(
        fmt::format("reconcile: expected at least 2 estimates, found {}", estimates.size()));
  }
  const auto pooled = numerics::pooled_mean(estimates);
  CombinedInertia result;
  result.value = pooled.mean.value;
  result.standard_uncertainty = pooled.mean.standard_uncertainty;
  result.between_methods = pooled.between;
  result.heterogeneity = pooled.heterogeneity;
  result.degrees_of_freedom = pooled.degrees_of_freedom;
  if (estimates.size() == 2) {
    // Two methods say nothing useful of the scatter between methods: the hull of their own.
    const auto own = [](const numerics::Uncertain& estimate) {
      return numerics::normal_interval(estimate.value, estimate.standard_uncertainty);
    };
    const numerics::Interval first = own(estimates[0]), second = own(estimates[1]);
    result.lower = std::min(first.lower, second.lower);
    result.upper = std::max(first.upper, second.upper);
  } else {
    const double reach =
        numerics::student_quantile(0.975, result.degrees_of_freedom) * result.standard_uncertainty;
    result.lower = result.value - reach;
    result.upper = result.value + reach;
  }
  const auto ratio = [&](double inertia) {
    return inertia > motor_inertia ? plant::motor_to_load_ratio(motor_inertia, inertia)
                                   : std::numeric_limits<double>::infinity();
  };
  result.motor_to_load_ratio = ratio(result.value);
  result.ratio_lower = ratio(result.upper);
  result.ratio_upper = ratio(result.lower);
  return result;
}

double tachometer_scale(double shaft_speed, double voltage, double motor_turns_per_turn) {
  return shaft_speed / voltage * motor_turns_per_turn;
}

FrictionAndOffset friction_and_offset(double torque_up, double torque_down) {
  return {0.5 * (torque_up + torque_down), 0.5 * (torque_down - torque_up)};
}

}  // namespace boresight::identification
