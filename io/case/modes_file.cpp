
#include <fmt/format.h>

#include <boresight/io/case/modes_file.hpp>
#include <boresight/io/units/unit_table.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/held_modes.hpp>

namespace boresight::io {

plant::StructureSpecification read_modes_file(const std::string& path) {
  const auto columns = read_unit_table(path, {{"frequency", Kind::frequency},
                                              {"damping_ratio", Kind::number},
                                              {"modal_inertia", Kind::inertia},
                                              {"bull_gear", Kind::number},
                                              {"encoder", Kind::number, false},
                                              {"beam", Kind::number},
                                              {"wind*", Kind::number}});
  const Eigen::VectorXd& inertia = columns.at("modal_inertia");
  if (!(inertia.minCoeff() > 0.0)) {
    throw InvalidInput(fmt::format("{}: expected modal inertias above 0, found {:g} kg.m2", path,
                                   inertia.minCoeff()));
  }
  // Shapes per root of the inertia that belongs to their scale.
  const auto shape = [&](const Eigen::VectorXd& column) -> Eigen::VectorXd {
    return column.cwiseQuotient(inertia.cwiseSqrt());
  };
  plant::VibrationModes modes;
  modes.frequency = two_pi * columns.at("frequency");
  modes.damping_ratio = columns.at("damping_ratio");
  modes.displacements = {"bull_gear_angle", "encoder", "beam"};
  modes.rates = {"bull_gear_rate", "", ""};
  modes.displacement_shape.resize(3, inertia.size());
  const auto encoder = columns.find("encoder");
  modes.displacement_shape.row(0) = shape(columns.at("bull_gear"));
  modes.displacement_shape.row(1) =
      shape(encoder == columns.end() ? columns.at("bull_gear") : encoder->second);
  modes.displacement_shape.row(2) = shape(columns.at("beam"));
  modes.forces = {"gear_torque"};
  modes.force_shape = modes.displacement_shape.row(0).transpose();
  for (const auto& [name, column] : columns) {
    if (!name.starts_with("wind")) continue;
    modes.forces.push_back(name);
    modes.force_shape.conservativeResize(Eigen::NoChange, modes.force_shape.cols() + 1);
    modes.force_shape.rightCols(1) = shape(column);
  }
  try {
    return plant::hold_bull_gear(modes);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace boresight::io
