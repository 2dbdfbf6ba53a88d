#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using States = AntennaStates;
using Channel = AntennaChannels;

void check(const NonlinearAntenna& antenna) {
  validate(antenna.valve);
  validate(antenna.oil);
  validate(antenna.friction);
  validate(antenna.offset);
  validate(antenna.gear);
  const auto require = [](bool satisfied, const char* expected, double found) {
    if (satisfied && std::isfinite(found)) return;
    throw InvalidInput(fmt::format("nonlinear antenna: expected {}, found {}", expected, found));
  };
  require(antenna.motor_inertia > 0.0, "a positive motor inertia", antenna.motor_inertia);
  require(antenna.viscous_friction >= 0.0, "a viscous friction of at least 0",
          antenna.viscous_friction);
  require(antenna.tachometer_corner > 0.0, "a positive tachometer corner",
          antenna.tachometer_corner);
}

// One line mode: state of its pressure wave, that of its companion, and what it does.
struct LineMode {
  Index wave;
  std::size_t motor;
  int side;          // 1 or 2
  double shape;      // at the motor port, +-1; 1 at the valve
  double drive;      // N m/rad: pressure wave per flow into the line
  double frequency;  // rad/s
  double damping_ratio;
};

std::vector<LineMode> line_modes(const OilCircuit& oil, Index first) {
  double length = 0.0;
  for (const auto& line : oil.lines) length += line.length;
  std::vector<LineMode> modes;
  for (std::size_t motor = 0; motor < oil.lines.size(); ++motor) {
    const auto& line = oil.lines[motor];
    const double mean_to_own = length / (static_cast<double>(oil.lines.size()) * line.length);
    for (const int side : {1, 2}) {
      const double stiffness = side == 1 ? oil.stiffness_1 : oil.stiffness_2;
      for (int k = 1; k <= oil.modes_per_line; ++k) {
        modes.push_back({first, motor, side, k % 2 == 0 ? 1.0 : -1.0, 2.0 * stiffness * mean_to_own,
                         two_pi * line.half_wave * k, line.damping_ratio});
        first += 2;
      }
    }
  }
  return modes;
}

// The linear core while it is put together.
struct Core {
  const NonlinearAntenna& antenna;
  const AntennaChannels& channels;
  StateSpace structure;
  std::vector<LineMode> lines;
  Index exogenous;  // inputs that are not channels
  StateSpace system;

  Index channel(Channel::Output output) const { return exogenous + channels.position(output); }
  double motors() const { return static_cast<double>(antenna.oil.lines.size()); }
};

void name_ports(Core& core) {
  auto& system = core.system;
  system.inputs = {"valve_command"};
  for (std::size_t i = 1; i < core.structure.inputs.size(); ++i) {
    system.inputs.push_back(core.structure.inputs[i]);
  }
  for (Index i = 0; i < core.channels.outputs(); ++i) {
    system.inputs.push_back(fmt::format("channel_{}", i + 1));
  }
  for (Index i = 0; i < core.channels.inputs(); ++i) {
    system.outputs.push_back(fmt::format("to_channels_{}", i + 1));
  }
  for (const char* name : {"tachometer", "motor_torque", "encoder", "beam", "motor_rate",
                           "motor_angle", "spool", "friction_torque", "gear_torque"}) {
    system.outputs.emplace_back(name);
  }
  for (std::size_t motor = 1; motor <= core.antenna.oil.lines.size(); ++motor) {
    system.outputs.push_back(fmt::format("inlet_pressure_{}", motor));
    system.outputs.push_back(fmt::format("outlet_pressure_{}", motor));
  }
  system.states = {"spool",       "spool_rate", "side_1",           "side_2",
                   "motor_angle", "motor_rate", "motor_tachometer", "bristle"};
  for (const auto& name : core.structure.states) system.states.push_back("structure." + name);
  for (const auto& line : core.lines) {
    const auto wave = fmt::format("line_{}_{}.{}", line.motor + 1, line.side, line.wave);
    system.states.push_back(wave);
    system.states.push_back(wave + ".companion");
  }
  const auto states = static_cast<Index>(system.states.size());
  const auto inputs = static_cast<Index>(system.inputs.size());
  const auto outputs = static_cast<Index>(system.outputs.size());
  system.a = Eigen::MatrixXd::Zero(states, states);
  system.b = Eigen::MatrixXd::Zero(states, inputs);
  system.c = Eigen::MatrixXd::Zero(outputs, states);
  system.d = Eigen::MatrixXd::Zero(outputs, inputs);
}

void add_valve(Core& core) {
  const auto& valve = core.antenna.valve;
  auto& a = core.system.a;
  a(States::spool, States::spool_rate) = valve.corner;
  a(States::spool_rate, States::spool) = -valve.corner;
  a(States::spool_rate, States::spool_rate) = -2.0 * valve.damping * valve.corner;
  core.system.b(States::spool_rate, 0) = valve.corner;
  if (core.channels.position(Channel::spool_slew) >= 0) {
    core.system.b(States::spool, core.channel(Channel::spool_slew)) = 1.0;
  }
}

void add_oil(Core& core) {
  const auto& oil = core.antenna.oil;
  auto& a = core.system.a;
  auto& b = core.system.b;
  const double own = 2.0 * oil.null_leakage + oil.case_leakage;
  const auto side = [&](Index row, Index other, double stiffness, double sign, Channel::Output flow,
                        Channel::Output softening) {
    a(row, States::spool) = sign * stiffness;
    a(row, States::motor_rate) = -sign * stiffness;
    a(row, row) = -stiffness * (oil.cross_leakage + own);
    a(row, other) = stiffness * oil.cross_leakage;
    b(row, core.channel(flow)) = stiffness;
    if (core.channels.position(softening) >= 0) b(row, core.channel(softening)) = stiffness;
  };
  side(States::side_1, States::side_2, oil.stiffness_1, 1.0, Channel::flow_1, Channel::softening_1);
  side(States::side_2, States::side_1, oil.stiffness_2, -1.0, Channel::flow_2,
       Channel::softening_2);
  for (const auto& line : core.lines) {
    const double sign = line.side == 1 ? 1.0 : -1.0;
    const Index companion = line.wave + 1;
    a(line.wave, States::spool) = sign * line.drive;
    a(line.wave, States::motor_rate) = -sign * line.drive * line.shape;
    a(line.wave, line.wave) = -2.0 * line.damping_ratio * line.frequency;
    a(line.wave, companion) = -line.frequency;
    a(companion, line.wave) = line.frequency;
    b(line.wave, core.channel(line.side == 1 ? Channel::flow_1 : Channel::flow_2)) = line.drive;
  }
}

// Torque of all motors from the pressures at their ports, as a row over the states.
Eigen::RowVectorXd motor_torque(const Core& core) {
  Eigen::RowVectorXd torque = Eigen::RowVectorXd::Zero(core.system.a.rows());
  torque[States::side_1] = 1.0;
  torque[States::side_2] = -1.0;
  for (const auto& line : core.lines) {
    torque[line.wave] = (line.side == 1 ? line.shape : -line.shape) / core.motors();
  }
  return torque;
}

void add_mechanics(Core& core) {
  const auto& antenna = core.antenna;
  auto& a = core.system.a;
  auto& b = core.system.b;
  const Index first = States::structure;
  const Index count = core.structure.a.rows();
  const double inertia = antenna.motor_inertia;
  const auto angle = core.structure.c.row(0);
  const auto rate = core.structure.c.row(1);
  // The gear's linear torque on the bull gear, over motor angle, motor rate and structure.
  Eigen::RowVectorXd gear = Eigen::RowVectorXd::Zero(a.cols());
  gear[States::motor_angle] = antenna.gear.stiffness;
  gear[States::motor_rate] = antenna.gear.damping;
  gear.segment(first, count) = -antenna.gear.stiffness * angle - antenna.gear.damping * rate;

  a(States::motor_angle, States::motor_rate) = 1.0;
  a.row(States::motor_rate) = (motor_torque(core) - gear) / inertia;
  a(States::motor_rate, States::motor_rate) -= antenna.viscous_friction / inertia;
  b(States::motor_rate, core.channel(Channel::friction_and_offset)) = -1.0 / inertia;
  a(States::tachometer, States::motor_rate) = antenna.tachometer_corner;
  a(States::tachometer, States::tachometer) = -antenna.tachometer_corner;
  if (core.channels.position(Channel::bristle_rate) >= 0) {
    b(States::bristle, core.channel(Channel::bristle_rate)) = 1.0;
  } else {
    a(States::bristle, States::bristle) = -1.0;  // rests
  }
  a.block(first, first, count, count) += core.structure.a;
  a.middleRows(first, count) += core.structure.b.col(0) * gear;
  b.block(first, 1, count, core.exogenous - 1) = core.structure.b.rightCols(core.exogenous - 1);
  if (core.channels.position(Channel::gear_deviation) >= 0) {
    b(States::motor_rate, core.channel(Channel::gear_deviation)) = -1.0 / inertia;
    b.col(core.channel(Channel::gear_deviation)).segment(first, count) += core.structure.b.col(0);
  }
}

void add_channel_inputs(Core& core) {
  auto& c = core.system.c;
  const auto from = [&](Channel::Input input, Index state) { c(input, state) = 1.0; };
  from(Channel::spool, States::spool);
  from(Channel::spool_rate, States::spool_rate);
  from(Channel::manifold_1, States::side_1);
  from(Channel::manifold_2, States::side_2);
  from(Channel::side_1, States::side_1);
  from(Channel::side_2, States::side_2);
  from(Channel::motor_rate, States::motor_rate);
  from(Channel::bristle, States::bristle);
  from(Channel::motor_angle, States::motor_angle);
  from(Channel::windup, States::motor_angle);
  from(Channel::windup_rate, States::motor_rate);
  for (const auto& line : core.lines) {
    c(line.side == 1 ? Channel::manifold_1 : Channel::manifold_2, line.wave) = 1.0 / core.motors();
  }
  const Index count = core.structure.a.rows();
  c.row(Channel::windup).segment(States::structure, count) -= core.structure.c.row(0);
  c.row(Channel::windup_rate).segment(States::structure, count) -= core.structure.c.row(1);
}

void add_observed(Core& core) {
  auto& c = core.system.c;
  auto& d = core.system.d;
  const Index count = core.structure.a.rows();
  Index row = core.channels.inputs();
  c(row++, States::tachometer) = 1.0;
  c.row(row++) = motor_torque(core);
  c.row(row++).segment(States::structure, count) = core.structure.c.row(2);  // encoder
  c.row(row++).segment(States::structure, count) = core.structure.c.row(3);  // beam
  c(row++, States::motor_rate) = 1.0;
  c(row++, States::motor_angle) = 1.0;
  c(row++, States::spool) = 1.0;
  d(row++, core.channel(Channel::friction_and_offset)) = 1.0;
  c.row(row) = core.antenna.gear.stiffness * c.row(Channel::windup) +
               core.antenna.gear.damping * c.row(Channel::windup_rate);
  if (core.channels.position(Channel::gear_deviation) >= 0) {
    d(row, core.channel(Channel::gear_deviation)) = 1.0;
  }
  ++row;
  const double pressure = 1.0 / core.antenna.oil.torque_per_pressure;
  for (std::size_t motor = 0; motor < core.antenna.oil.lines.size(); ++motor) {
    c(row, States::side_1) = pressure;
    c(row + 1, States::side_2) = pressure;
    for (const auto& line : core.lines) {
      if (line.motor == motor) c(row + line.side - 1, line.wave) = pressure * line.shape;
    }
    row += 2;
  }
}

Core assemble(const NonlinearAntenna& antenna, const AntennaChannels& channels) {
  Core core{antenna, channels, structure_dynamics(antenna.structure), {}, 0, {}};
  core.exogenous = static_cast<Index>(core.structure.inputs.size());
  core.lines = line_modes(antenna.oil, States::structure + core.structure.a.rows());
  name_ports(core);
  add_valve(core);
  add_oil(core);
  add_mechanics(core);
  add_channel_inputs(core);
  add_observed(core);
  return core;
}

std::shared_ptr<const AntennaChannels> make_channels(const NonlinearAntenna& antenna) {
  return std::make_shared<const AntennaChannels>(antenna.valve, antenna.oil, antenna.friction,
                                                 antenna.offset, antenna.gear);
}

Index state_count(const NonlinearAntenna& antenna) {
  return States::structure + rigid_rotation(antenna.structure).size() +
         4 * static_cast<Index>(antenna.oil.lines.size()) * antenna.oil.modes_per_line;
}

}  // namespace

FeedbackSystem to_feedback_system(const NonlinearAntenna& antenna) {
  check(antenna);
  auto channels = make_channels(antenna);
  FeedbackSystem system;
  system.linear = assemble(antenna, *channels).system;
  system.channel_outputs = channels->outputs();
  system.channel_inputs = channels->inputs();
  system.channels = std::move(channels);
  return system;
}

Eigen::VectorXd rigid_rotation(const NonlinearAntenna& antenna) {
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(state_count(antenna));
  const Eigen::VectorXd structure = rigid_rotation(antenna.structure);
  turn[States::motor_angle] = 1.0;
  turn.segment(States::structure, structure.size()) = structure;
  return turn;
}

Eigen::VectorXd state_at_rest(const NonlinearAntenna& antenna) {
  check(antenna);
  const auto& oil = antenna.oil;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(state_count(antenna));
  const double leak = 2.0 * oil.null_leakage + oil.case_leakage;
  const double sum = oil.supply_torque + oil.return_torque;
  state[States::side_1] = state[States::side_2] =
      leak > 0.0 ? oil.null_leakage * sum / leak : 0.5 * sum;
  return state;
}

double stored_energy(const NonlinearAntenna& antenna, const Eigen::VectorXd& state) {
  check(antenna);
  const auto channels = make_channels(antenna);
  const Core core = assemble(antenna, *channels);
  if (state.size() != core.system.a.rows()) {
    throw InvalidInput(fmt::format("stored_energy: expected {} states, found {}",
                                   core.system.a.rows(), state.size()));
  }
  const auto& oil = antenna.oil;
  const double mean = state_at_rest(antenna)[States::side_1];
  double energy = 0.5 * antenna.motor_inertia * std::pow(state[States::motor_rate], 2) +
                  0.5 * std::pow(state[States::side_1] - mean, 2) / oil.stiffness_1 +
                  0.5 * std::pow(state[States::side_2] - mean, 2) / oil.stiffness_2 +
                  0.5 * antenna.friction.bristle_stiffness * std::pow(state[States::bristle], 2);
  for (const auto& line : core.lines) {
    energy += 0.5 * (std::pow(state[line.wave], 2) + std::pow(state[line.wave + 1], 2)) /
              (line.drive * core.motors());
  }
  const Eigen::VectorXd structure = state.segment(States::structure, core.structure.a.rows());
  const double windup = state[States::motor_angle] - core.structure.c.row(0).dot(structure);
  return energy + gear_energy(antenna.gear, windup) +
         structure_energy(antenna.structure, structure);
}

}  // namespace boresight::plant
