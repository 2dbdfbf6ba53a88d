#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/golden_section.hpp>
#include <boresight/plant/antenna/antenna_modal_system.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/minimal_realisation.hpp>
#include <boresight/plant/linear/response_grid.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using Names = std::vector<std::string>;
constexpr std::complex<double> nothing{std::numeric_limits<double>::quiet_NaN(), 0.0};

Eigen::Index place(const Names& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : found - names.begin();
}

// As a controller's samples see it.
plant::StateSpace sampled_antenna(const plant::AntennaPlant& antenna, double sample_time) {
  return plant::sample(plant::subsystem(plant::to_state_space(antenna), {"valve_command"},
                                        {sensor_names.begin(), sensor_names.end()}),
                       sample_time);
}

// The largest gain on a grid around every pole, refined; nothing is said of an upper bound.
PeakGain gain_seen(const plant::StateSpace& system) {
  plant::DenseResponse response(system);
  const double nyquist = std::numbers::pi / system.sample_time;
  const Eigen::ArrayXd grid = plant::response_grid(numerics::eigenvalues(system.a),
                                                   system.sample_time, {.highest = nyquist});
  Eigen::ArrayXcd values(grid.size());
  response.evaluate(grid, values);
  Eigen::Index top = 0;
  values.abs().maxCoeff(&top);
  const double low = std::log(grid[std::max<Eigen::Index>(0, top - 1)]);
  const double high = std::log(grid[std::min<Eigen::Index>(grid.size() - 1, top + 1)]);
  const auto gain = [&](double x) { return std::abs(response.channel(std::exp(x))); };
  const double place = numerics::golden_section_maximum(gain, low, high, 1e-9);
  PeakGain peak;
  peak.frequency = std::exp(place);
  peak.lower = gain(place);
  peak.upper = std::numeric_limits<double>::infinity();
  return peak;
}

}  // namespace

plant::StateSpace antenna_state_space_controller(const plant::StateSpace& controller) {
  plant::validate(controller);
  plant::StateSpace system = controller;
  if (place(system.outputs, "valve_demand") < 0) {
    std::ranges::replace(system.outputs, std::string("valve_command"), std::string("valve_demand"));
  }
  Names inputs;
  for (const auto& name : system.inputs) {
    if (name != "reference" && name != "angle_reference") inputs.push_back(name);
  }
  const bool opens = place(inputs, "rate_disturbance") >= 0;
  const bool shows = place(system.outputs, "rate_command") >= 0;
  const auto refuse = [](const std::string& expected, const std::string& found) {
    throw InvalidInput(
        fmt::format("antenna_state_space_controller: expected {}, found {}", expected, found));
  };
  const auto known = [](const std::string& name) {
    return name == "rate_disturbance" ||
           std::ranges::find(sensor_names, name) != sensor_names.end();
  };
  const auto stranger = std::ranges::find_if_not(inputs, known);
  if (stranger != inputs.end()) {
    refuse("inputs among tachometer, encoder, motor_torque, rate_disturbance",
           fmt::format("'{}'", *stranger));
  }
  if (inputs.size() == (opens ? 1U : 0U)) {
    refuse("an input tachometer, encoder or motor_torque", "none");
  }
  for (const auto& name : system.outputs) {
    if (name != "valve_demand" && name != "rate_command") {
      refuse("outputs among valve_demand, rate_command", fmt::format("'{}'", name));
    }
  }
  if (place(system.outputs, "valve_demand") < 0) refuse("an output valve_demand", "none");
  if (opens != shows) {
    refuse("rate_disturbance and rate_command both or neither",
           opens ? "the first alone" : "the second alone");
  }
  Names outputs{"valve_demand"};
  if (shows) outputs.emplace_back("rate_command");
  return plant::subsystem(system, inputs, outputs);
}

plant::StateSpace rate_loop_of(const plant::StateSpace& controller) {
  plant::StateSpace system = antenna_state_space_controller(controller);
  const Eigen::Index disturbance = place(system.inputs, "rate_disturbance");
  if (disturbance >= 0) {
    // The disturbance takes off what the controller commands of itself.
    const Eigen::RowVectorXd state_row = system.c.row(1);
    Eigen::RowVectorXd direct_row = system.d.row(1);
    direct_row[disturbance] = 0.0;
    const Eigen::VectorXd into_states = system.b.col(disturbance);
    const double into_demand = system.d(0, disturbance);
    system.a -= into_states * state_row;
    system.b -= into_states * direct_row;
    system.c.row(0) -= into_demand * state_row;
    system.d.row(0) -= into_demand * direct_row;
  }
  Names inputs;
  for (const char* name : {"tachometer", "motor_torque"}) {
    if (place(system.inputs, name) >= 0) inputs.emplace_back(name);
  }
  if (inputs.empty()) {
    throw InvalidInput(
        "rate_loop_of: expected a controller that reads tachometer or motor_torque, found neither");
  }
  return plant::minimal_realisation(plant::subsystem(system, inputs, {"valve_demand"})).system;
}

ControlledAntenna::ControlledAntenna(const plant::AntennaPlant& antenna,
                                     const plant::StateSpace& controller, double delay)
    : plant_(antenna),
      controller_(antenna_state_space_controller(controller)),
      delay_(delay),
      sample_time_(controller.sample_time) {
  if (!(delay >= 0.0) || !std::isfinite(delay)) {
    throw InvalidInput(
        fmt::format("ControlledAntenna: expected a delay of 0 or more, found {} s", delay));
  }
  const plant::StateSpace system = antenna_state_space_controller(controller);
  for (std::size_t i = 0; i < sensor_names.size(); ++i) {
    column_.at(i) = place(system.inputs, sensor_names.at(i));
    reads_.at(i) = column_.at(i) >= 0;
  }
  rate_disturbance_ = place(system.inputs, "rate_disturbance");
  rate_command_ = place(system.outputs, "rate_command");
  response_.resize(system.d.rows(), system.d.cols());
  if (sample_time_ > 0.0) {
    sampled_plant_.emplace(sampled_antenna(antenna, sample_time_));
    sampled_response_.resize(3, 1);
  }
}

bool ControlledAntenna::has(LoopBreak loop_break) const {
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return reads_[0] || reads_[2];
    case LoopBreak::valve_command:
      return true;
    case LoopBreak::position_loop:
      break;
  }
  return reads_[1];
}

double ControlledAntenna::nyquist_frequency() const {
  return sample_time_ > 0.0 ? std::numbers::pi / sample_time_
                            : std::numeric_limits<double>::infinity();
}

ControlledPoint ControlledAntenna::at(double frequency) {
  using Complex = std::complex<double>;
  const plant::ResponsePoint point = plant_(frequency);
  const std::array wind{point.tachometer_wind, point.encoder_wind, point.torque_wind};
  std::array command{point.tachometer_command, point.encoder_command, point.torque_command};
  const Complex i{0.0, 1.0};
  // From the demand to the valve, and from the demand through the plant to each sensor.
  Complex to_valve = std::polar(1.0, -frequency * delay_);
  Complex s = i * frequency;
  if (sampled_plant_) {
    const double half = 0.5 * frequency * sample_time_;
    s = std::polar(1.0, 2.0 * half);
    const double hold = half < 1e-8 ? 1.0 : std::sin(half) / half;
    to_valve = hold * std::polar(1.0, -3.0 * half);  // hold, one sample of computation
    if (!sampled_plant_->evaluate(s, sampled_response_)) sampled_response_.setConstant(nothing);
    for (std::size_t k = 0; k < command.size(); ++k) {
      command.at(k) = sampled_response_(static_cast<Eigen::Index>(k), 0) / s;
    }
  } else {
    for (auto& channel : command) channel *= to_valve;
  }
  if (!controller_.evaluate(s, response_)) response_.setConstant(nothing);

  ControlledPoint result;
  Complex valve{}, rate{}, driven{};
  const bool opens = rate_disturbance_ >= 0;
  const Complex through = opens ? response_(demand_, rate_disturbance_) : Complex{};
  for (std::size_t k = 0; k < command.size(); ++k) {
    const Eigen::Index column = column_.at(k);
    if (column < 0) continue;
    const Complex gain = response_(demand_, column);
    valve -= gain * command.at(k);
    driven += gain * wind.at(k);
    if (opens) {
      rate -= (gain - through * response_(rate_command_, column)) * command.at(k);
    } else if (k != 1) {
      rate -= gain * command.at(k);
    }
  }
  const Complex sensitivity = 1.0 / (1.0 + valve);
  result.loop_gain = {rate, valve, (valve - rate) / (1.0 + rate)};
  for (std::size_t b = 0; b < loop_breaks.size(); ++b) {
    if (!has(loop_breaks.at(b))) result.loop_gain.at(b) = nothing;
  }
  const Complex boresight_by_demand = point.boresight_command * to_valve * sensitivity;
  result.boresight_by_wind = point.boresight_wind + boresight_by_demand * driven;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const Complex gain = column_.at(k) < 0 ? Complex{} : response_(demand_, column_.at(k));
    result.boresight_by_noise.at(k) = boresight_by_demand * gain;
    result.demand_by_noise.at(k) = sensitivity * gain;
  }
  return result;
}

PeakGain worst_compliance(const plant::AntennaPlant& antenna, const plant::StateSpace& controller,
                          double delay, const PeakGainOptions& options) {
  plant::StateSpace system = antenna_state_space_controller(controller);
  Names inputs = system.inputs;
  std::erase(inputs, "rate_disturbance");
  system = plant::subsystem(system, inputs, {"valve_demand"});
  if (system.sample_time > 0.0) {
    const SampledLoop loop{plant::to_state_space(antenna),
                           plant::renamed(system, {{"valve_demand", "valve_command"}}),
                           system.sample_time};
    const auto closed = plant::subsystem(sampled_closed_loop(loop), {"wind_torque"}, {"beam"});
    constexpr Eigen::Index certified_states = 80;
    return closed.a.rows() > certified_states ? gain_seen(closed) : peak_gain(closed, options);
  }
  plant::ModalSystem whole = plant::to_modal_system(antenna);
  Names all_inputs{"wind_torque", "valve_command"}, all_outputs{"beam", "valve_demand"};
  for (const auto& names : {whole.modes.displacements, whole.modes.rates}) {
    std::ranges::copy_if(names, std::back_inserter(all_inputs),
                         [](const std::string& name) { return !name.empty(); });
  }
  std::ranges::copy(whole.modes.forces, std::back_inserter(all_outputs));
  whole.core = plant::connect({whole.core, system}, all_inputs, all_outputs);
  whole.dead_times = {{"valve_demand", "valve_command", delay}};
  whole.inputs = {"wind_torque"};
  whole.outputs = {"beam"};
  return peak_gain(whole, "wind_torque", "beam", options);
}

}  // namespace boresight::control
