#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A solid disk of a rotating assembly, or a part whose inertia is given.
struct AssemblyPart {
  std::string name;
  std::string description;
  std::optional<Quantity> radius;
  std::optional<Quantity> length;
  std::optional<Quantity> inertia;
};

/// Bodies that turn together behind the first `stages` reductions; `count` of them, one per motor.
struct RotatingAssembly {
  std::string name;
  std::string description;
  long count = 1;
  std::size_t stages = 0;
  std::optional<Quantity> inertia;  // of one, about its own axis; else the sum of the parts
  std::vector<AssemblyPart> parts;
};

struct GearStageEntry {
  Quantity driven_teeth;
  Quantity driving_teeth;
};

struct GearTrainEntry {
  std::vector<GearStageEntry> stages;
  std::optional<Quantity> density;
  std::vector<RotatingAssembly> assemblies;
};

/// The antenna inertia according to another passage of the source.
struct AntennaAlternative {
  std::string name;
  std::optional<Quantity> inertia;            // about the antenna axis
  std::optional<Quantity> reflected_inertia;  // at the motor shaft
  /// The springs are the case's and the frequencies others, as of another attitude; else the other
  /// way round, as of another estimate.
  bool keeps_springs = false;
};

struct AntennaEntry {
  Quantity dish_diameter;
  Quantity inertia;  // about the antenna axis
  /// Where the dish points in the design wind and at the start of simulated tests.
  std::optional<Quantity> azimuth, elevation;
  /// Angle of the Y axis of an X-Y mount, 0 with the boresight perpendicular to X; for an X
  /// axis only.
  std::optional<Quantity> y_angle;
  std::vector<AntennaAlternative> alternatives;
};

}  // namespace boresight::io
