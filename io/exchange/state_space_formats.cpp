#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include <boresight/io/exchange/state_space_formats.hpp>

namespace boresight::io {
namespace {

using Json = nlohmann::ordered_json;

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string signal_unit(std::string_view name) {
  constexpr std::array<std::string_view, 2> angles{"encoder", "beam"};
  // The valve's flow is the speed that its oil would give the motors without load.
  constexpr std::array<std::string_view, 6> rates{"tachometer",      "valve_flow",
                                                  "valve_flow_rate", "valve_command",
                                                  "valve_demand",    "rate_command"};
  const auto is_of = [&](const auto& names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_of(rates) || name.ends_with("_rate") || name == "rate_disturbance" ||
      name == "tachometer_noise") {
    return "rad/s";
  }
  if (name.ends_with("torque") || name == "torque_noise") return "N.m";
  if (is_of(angles) || name.ends_with("_angle") || name == "encoder_noise") return "rad";
  return "";
}

std::vector<std::string> signal_units(const std::vector<std::string>& names) {
  std::vector<std::string> units;
  units.reserve(names.size());
  for (const auto& name : names) units.push_back(signal_unit(name));
  return units;
}

Json state_space_json(const plant::StateSpace& system) {
  return {{"inputs", system.inputs},   {"input_units", signal_units(system.inputs)},
          {"outputs", system.outputs}, {"output_units", signal_units(system.outputs)},
          {"states", system.states},   {"state_units", signal_units(system.states)},
          {"angles", "motor"},         {"sample_time", system.sample_time},
          {"A", rows_of(system.a)},    {"B", rows_of(system.b)},
          {"C", rows_of(system.c)},    {"D", rows_of(system.d)}};
}

MatVariables state_space_mat(const plant::StateSpace& system) {
  MatVariables fields;
  fields.add_matrix("A", system.a);
  fields.add_matrix("B", system.b);
  fields.add_matrix("C", system.c);
  fields.add_matrix("D", system.d);
  fields.add_number("Ts", system.sample_time);
  fields.add_texts("inputs", system.inputs);
  fields.add_texts("input_units", signal_units(system.inputs));
  fields.add_texts("outputs", system.outputs);
  fields.add_texts("output_units", signal_units(system.outputs));
  fields.add_texts("states", system.states);
  fields.add_texts("state_units", signal_units(system.states));
  fields.add_text("angles", "motor");
  return fields;
}

}  // namespace boresight::io
