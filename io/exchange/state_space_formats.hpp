#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/io/records/mat_writer.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::io {

/// The SI unit of a signal or state of an antenna's models by its name: "rad/s" of "motor_rate",
/// "N.m" of "motor_torque", "rad" of `boresight`. Empty for an unknown name, such as a controller's
/// own states.
std::string signal_unit(std::string_view name);
std::vector<std::string> signal_units(const std::vector<std::string>& names);

/// {inputs, input_units, outputs, output_units, states, state_units, angles, sample_time, A, B, C,
/// D}: matrices by rows, numbers in the shortest form that reads back bit by bit; the form that
/// read_controller takes (docs/benchmark-protocol.md). SI, angles at the motor shaft; state units
/// are empty texts where a state has none of its own.
nlohmann::ordered_json state_space_json(const plant::StateSpace& system);

/// The same as fields A, B, C, D, Ts, inputs, input_units, ..., angles of a structure, names as
/// columns of cells.
MatVariables state_space_mat(const plant::StateSpace& system);

}  // namespace boresight::io
