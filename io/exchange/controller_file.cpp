#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/io/units/units.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr std::uintmax_t largest_file = 64U << 20U;
constexpr Eigen::Index max_states = 300;

// What a name of a signal stands for; a sign of 0 is a reference that rests.
struct Signal {
  std::string_view name, meaning;
  double sign = 1.0;
  Kind kind = Kind::number;
  bool angle = false;
};
constexpr std::array input_signals{
    Signal{"tachometer", "tachometer", 1.0, Kind::angular_rate, false},
    Signal{"encoder", "encoder", 1.0, Kind::angle, true},
    Signal{"position_error", "encoder", -1.0, Kind::angle, true},
    Signal{"motor_torque", "motor_torque", 1.0, Kind::torque, false},
    Signal{"rate_disturbance", "rate_disturbance", 1.0, Kind::angular_rate, false},
    Signal{"reference", "", 0.0, Kind::angle, true},
    Signal{"angle_reference", "", 0.0, Kind::angle, true},
    Signal{"rate_reference", "", 0.0, Kind::angular_rate, false},
};
constexpr std::array output_signals{
    Signal{"valve_demand", "valve_demand", 1.0, Kind::angular_rate, false},
    Signal{"valve_command", "valve_demand", 1.0, Kind::angular_rate, false},
    Signal{"rate_command", "rate_command", 1.0, Kind::angular_rate, false},
};

template <std::size_t count>
const Signal& signal_of(const std::array<Signal, count>& known, const std::string& name,
                        const std::string& file, const char* what) {
  std::vector<std::string_view> names;
  for (const Signal& signal : known) {
    if (signal.name == name) return signal;
    names.push_back(signal.name);
  }
  const auto near = nearest_name(name, names);
  throw InvalidInput(fmt::format("{}: {}: expected one of {}, found {}{}", file, what,
                                 fmt::join(names, ", "), in_quotes(name),
                                 near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

// How many SI units one unit of the file is.
double factor_of(const std::string& unit, const Signal& signal, const std::string& file) {
  if (unit.empty()) return 1.0;
  Unit read;
  try {
    read = parse_unit(unit);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: unit of {}: {}", file, signal.name, error.what()));
  }
  if (read.dimension != parse_unit(describe(signal.kind).si_unit).dimension) {
    throw InvalidInput(fmt::format("{}: unit of {}: expected {}, found {}", file, signal.name,
                                   expectation(signal.kind), in_quotes(unit)));
  }
  return read.factor;
}

void check_sizes(const ControllerText& text, const std::string& file) {
  const auto size = [](const Eigen::MatrixXd& matrix) {
    return fmt::format("{} x {}", matrix.rows(), matrix.cols());
  };
  const Eigen::Index n = text.a.rows();
  const auto inputs = static_cast<Eigen::Index>(text.inputs.size());
  const auto outputs = static_cast<Eigen::Index>(text.outputs.size());
  const auto require = [&](const char* name, const Eigen::MatrixXd& matrix, Eigen::Index rows,
                           Eigen::Index columns) {
    if (matrix.rows() != rows || matrix.cols() != columns) {
      throw InvalidInput(
          fmt::format("{}: {}: expected {} x {} for {} states, {} inputs and {} outputs, found {}",
                      file, name, rows, columns, n, inputs, outputs, size(matrix)));
    }
    if (!matrix.allFinite()) {
      throw InvalidInput(
          fmt::format("{}: {}: expected finite elements, found NaN or infinity", file, name));
    }
  };
  if (n > max_states) {
    throw InvalidInput(
        fmt::format("{}: A: expected at most {} states, found {}", file, max_states, n));
  }
  require("A", text.a, n, n);
  require("D", text.d, outputs, inputs);
  require("B", text.b, n, inputs);
  require("C", text.c, outputs, n);
  if (!(text.sample_time >= 0.0) || !std::isfinite(text.sample_time)) {
    throw InvalidInput(fmt::format("{}: sample time: expected 0 (continuous) or more, found {} s",
                                   file, text.sample_time));
  }
  if (text.angles != "motor" && text.angles != "sky") {
    throw InvalidInput(
        fmt::format("{}: angles: expected motor or sky, found {}", file, in_quotes(text.angles)));
  }
  const auto units = [&](const char* name, const std::vector<std::string>& list,
                         Eigen::Index count) {
    if (!list.empty() && static_cast<Eigen::Index>(list.size()) != count) {
      throw InvalidInput(fmt::format("{}: {}: expected {} units or none, found {}", file, name,
                                     count, list.size()));
    }
  };
  units("input_units", text.input_units, inputs);
  units("output_units", text.output_units, outputs);
}

std::string unit_at(const std::vector<std::string>& units, std::size_t i) {
  return units.empty() ? std::string() : units[i];
}

}  // namespace

ControllerFile parse_controller(std::string_view content, const std::string& name,
                                double gear_ratio, const ControllerNames& names) {
  ControllerText text = is_mat(content) ? controller_from_mat(content, name, names.part)
                                        : controller_from_json(content, name, names.part);
  ControllerFile file;
  const auto fill = [&](std::vector<std::string>& own, const std::vector<std::string>& given,
                        const char* what) {
    if (own.empty()) own = given;
    if (own.empty()) {
      throw InvalidInput(fmt::format(
          "{}: expected names of the {} in the file or by --{}, found none", name, what, what));
    }
  };
  fill(text.inputs, names.inputs, "inputs");
  fill(text.outputs, names.outputs, "outputs");
  check_sizes(text, name);

  // Columns and rows in SI at the motor; references rest.
  std::vector<Eigen::Index> kept;
  plant::StateSpace& system = file.system;
  for (std::size_t i = 0; i < text.inputs.size(); ++i) {
    const Signal& signal = signal_of(input_signals, text.inputs[i], name, "inputs");
    const auto column = static_cast<Eigen::Index>(i);
    const double at_sky = signal.angle && text.angles == "sky" ? gear_ratio : 1.0;
    const double unit = factor_of(unit_at(text.input_units, i), signal, name);
    if (signal.sign == 0.0) {
      file.remarks.push_back(fmt::format("input {} is a reference and rests at 0", signal.name));
      continue;
    }
    const double factor = signal.sign / (unit * at_sky);
    text.b.col(column) *= factor;
    text.d.col(column) *= factor;
    if (signal.name != signal.meaning) {
      file.remarks.push_back(
          fmt::format("input {} is taken as minus the {}", signal.name, signal.meaning));
    }
    kept.push_back(column);
    system.inputs.emplace_back(signal.meaning);
  }
  for (std::size_t i = 0; i < text.outputs.size(); ++i) {
    const Signal& signal = signal_of(output_signals, text.outputs[i], name, "outputs");
    const double unit = factor_of(unit_at(text.output_units, i), signal, name);
    text.c.row(static_cast<Eigen::Index>(i)) *= unit;
    text.d.row(static_cast<Eigen::Index>(i)) *= unit;
    system.outputs.emplace_back(signal.meaning);
  }
  system.a = text.a;
  system.b = text.b(Eigen::all, kept);
  system.c = text.c;
  system.d = text.d(Eigen::all, kept);
  system.sample_time = text.sample_time;
  for (Eigen::Index i = 0; i < text.a.rows(); ++i) {
    system.states.push_back(fmt::format("controller_{}", i + 1));
  }
  if (text.angles == "sky") {
    file.remarks.emplace_back("angles of the file are at the sky, all else at the motor");
  }
  try {
    system = control::antenna_state_space_controller(system);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", name, error.what()));
  }
  return file;
}

ControllerFile read_controller(const std::string& path, double gear_ratio,
                               const ControllerNames& names) {
  return parse_controller(read_input(path, largest_file), path, gear_ratio, names);
}

void write_controller(const std::string& path, const plant::StateSpace& controller) {
  write_atomically(
      path, path.ends_with(".mat") ? controller_mat(controller) : controller_json(controller));
}

}  // namespace boresight::io
