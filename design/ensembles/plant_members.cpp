#include <array>
#include <numeric>

#include <fmt/format.h>

#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

// What one member has instead of the case's numbers, in the order of MemberRanges.
struct MemberValues {
  double structure_frequency = 1.0, oil_stiffness = 1.0, leakage_rate = 0.0, viscous_friction = 0.0;
};

plant::AntennaPlant plant_of(const plant::Antenna& antenna, const MemberValues& values) {
  return linear_plant(
      changed(antenna, {plant::set_to("drive.viscous_friction", values.viscous_friction),
                        plant::scaled_by("at_shaft.oil_stiffness", values.oil_stiffness),
                        plant::set_to("drive.leakage_rate", values.leakage_rate),
                        plant::scaled_by("structure.frequencies", values.structure_frequency)}));
}

// Uniform within [0, 1), number `index` of a stream.
double uniform(std::uint64_t state, std::size_t index) {
  constexpr double unit = 0x1p-53;
  return static_cast<double>(numerics::splitmix64(state, index) >> 11U) * unit;
}

// One number in each of `count` equal parts of [0, 1), the parts in a random order.
std::vector<double> stratified(std::size_t count, std::uint64_t state) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    const auto other = static_cast<std::size_t>(uniform(state, i) * static_cast<double>(i));
    std::swap(order[i - 1], order[other]);
  }
  std::vector<double> numbers;
  numbers.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back((static_cast<double>(order[i]) + uniform(state, count + 1 + i)) /
                      static_cast<double>(count));
  }
  return numbers;
}

double between(const Ends& ends, double fraction) {
  return ends.lower + fraction * (ends.upper - ends.lower);
}

}  // namespace

std::string_view to_string(EnsembleSource source) {
  return source == EnsembleSource::records ? "sampled from the identified distribution"
                                           : "sampled from the ranges of the case";
}

std::vector<EnsembleMember> plant_members(const Mission& mission, std::uint64_t seed) {
  const MemberRanges& ranges = mission.uncertainty.ranges;
  const plant::DriveRatings& drive = mission.antenna.drive;
  const MemberValues own{1.0, 1.0, drive.leakage_rate, drive.viscous_friction};
  std::vector<EnsembleMember> members;
  const auto add = [&](std::string name, const MemberValues& values) {
    members.push_back({std::move(name), plant_of(mission.antenna, values)});
  };
  add("nominal", own);
  MemberValues changed_value = own;
  changed_value.structure_frequency = ranges.structure_frequency.lower;
  add(fmt::format("structure frequencies x {:g}", changed_value.structure_frequency),
      changed_value);
  changed_value.structure_frequency = ranges.structure_frequency.upper;
  add(fmt::format("structure frequencies x {:g}", changed_value.structure_frequency),
      changed_value);
  changed_value = own;
  changed_value.oil_stiffness = ranges.oil_stiffness.lower;
  add(fmt::format("oil stiffness x {:g}", changed_value.oil_stiffness), changed_value);
  changed_value.oil_stiffness = ranges.oil_stiffness.upper;
  add(fmt::format("oil stiffness x {:g}", changed_value.oil_stiffness), changed_value);
  changed_value = own;
  changed_value.leakage_rate = ranges.leakage_rate.lower;
  add(fmt::format("leakage rate {:.4g} 1/s", changed_value.leakage_rate), changed_value);

  const std::size_t random_samples = mission.uncertainty.random_samples;
  std::array<std::vector<double>, 4> fractions;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    fractions.at(i) = stratified(random_samples, numerics::splitmix64(seed, i));
  }
  for (std::size_t i = 0; i < random_samples; ++i) {
    add(fmt::format("sample {}", i + 1), {between(ranges.structure_frequency, fractions[0][i]),
                                          between(ranges.oil_stiffness, fractions[1][i]),
                                          between(ranges.leakage_rate, fractions[2][i]),
                                          between(ranges.viscous_friction, fractions[3][i])});
  }
  return members;
}

std::vector<EnsembleMember> corner_members(const Mission& mission) {
  using enum UncertainInput;
  constexpr double median = 0.5, lower = 0.05, upper = 0.95;
  const auto distribution = PlantDistribution::of_ranges(mission);
  std::vector<std::vector<double>> corners{{}};
  for (const UncertainInput input : distribution.inputs()) {
    std::vector<double> ends{median};
    if (input == structure_frequency || input == oil_stiffness || input == antenna_inertia) {
      ends = {lower, upper};
    } else if (input == leakage_rate || input == friction_slope) {
      ends = {lower};
    }
    std::vector<std::vector<double>> next;
    for (const auto& corner : corners) {
      for (const double end : ends) {
        next.push_back(corner);
        next.back().push_back(end);
      }
    }
    corners = std::move(next);
  }
  std::vector<EnsembleMember> members;
  for (const auto& corner : corners) {
    members.push_back(
        {fmt::format("corner {}", members.size() + 1),
         linear_plant(changed(mission.antenna, changes_of(distribution.at_fractions(corner))))});
  }
  return members;
}

}  // namespace boresight::design
