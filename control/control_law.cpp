#include <cmath>

#include <fmt/format.h>

#include <boresight/control/control_law.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

constexpr GainDescription rate_gain{Gain::rate_gain, "rate gain", "kr", "1", 0.01, 30.0};
constexpr GainDescription rate_integral{
    Gain::rate_integral, "rate integral corner", "wi", "rad/s", 0.01, 30.0};
constexpr GainDescription rate_lag{Gain::rate_lag, "rate lag corner", "wp", "rad/s", 0.3, 300.0};
constexpr GainDescription position_gain{
    Gain::position_gain, "position gain", "kp", "1/s", 0.03, 30.0};
constexpr GainDescription position_integral{
    Gain::position_integral, "position integral corner", "wip", "rad/s", 1e-4, 3.0};

}  // namespace

std::string_view to_string(LoopStructure structure) {
  return structure == LoopStructure::pi ? "PI without lag" : "PI with lag";
}

const std::vector<GainDescription>& gain_descriptions(LoopStructure structure) {
  static const std::vector<GainDescription> without_lag{rate_gain, rate_integral, position_gain,
                                                        position_integral};
  static const std::vector<GainDescription> with_lag{rate_gain, rate_integral, rate_lag,
                                                     position_gain, position_integral};
  return structure == LoopStructure::pi ? without_lag : with_lag;
}

void validate(const ControlLaw& law) {
  const auto& descriptions = gain_descriptions(law.structure);
  if (law.gains.size() != descriptions.size()) {
    throw InvalidInput(fmt::format("control law: expected {} gains for {}, found {}",
                                   descriptions.size(), to_string(law.structure),
                                   law.gains.size()));
  }
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    if (!(law.gains[i] > 0.0) || !std::isfinite(law.gains[i])) {
      throw InvalidInput(fmt::format("control law: expected a positive finite {}, found {}",
                                     descriptions[i].name, law.gains[i]));
    }
  }
}

double gain(const ControlLaw& law, Gain kind) {
  const auto& descriptions = gain_descriptions(law.structure);
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    if (descriptions[i].gain == kind) return law.gains[i];
  }
  throw InvalidInput(fmt::format("control law: {} has no such gain", to_string(law.structure)));
}

CompensatorResponse compensator_response(const ControlLaw& law, double angular_frequency) {
  const double w = angular_frequency;
  CompensatorResponse response;
  response.rate = 1.0;
  response.position = 1.0;
  const auto& descriptions = gain_descriptions(law.structure);
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    const double value = law.gains[i];
    // value/(s + value) and s/(s + value) at s = j w, with one division for both
    const double scale = 1.0 / (value * value + w * w);
    const std::complex<double> low{value * value * scale, -value * w * scale};
    const std::complex<double> high{w * w * scale, value * w * scale};
    switch (descriptions[i].gain) {
      case Gain::rate_gain:
        response.rate *= value;
        response.rate_by_gain[i] = 1.0;
        break;
      case Gain::rate_integral:
        response.rate *= std::complex<double>{1.0, -value / w};
        response.rate_by_gain[i] = low;
        break;
      case Gain::rate_lag:
        response.rate *= low;
        response.rate_by_gain[i] = high;
        break;
      case Gain::position_gain:
        response.position *= value;
        response.position_by_gain[i] = 1.0;
        break;
      case Gain::position_integral:
        response.position *= std::complex<double>{1.0, -value / w};
        response.position_by_gain[i] = low;
        break;
    }
  }
  return response;
}

plant::StateSpace to_state_space(const ControlLaw& law) {
  validate(law);
  const double kr = gain(law, Gain::rate_gain);
  const double wi = gain(law, Gain::rate_integral);
  const double kp = gain(law, Gain::position_gain);
  const double wip = gain(law, Gain::position_integral);
  // The integrators carry rad/s and rad of command, the size of what they add to.
  const auto position = plant::rational({kp * wip, kp}, {0.0, 1.0}, "encoder", "position_output",
                                        "position_integrator");
  Eigen::MatrixXd sum(1, 2);
  sum << -1.0, 1.0;
  const auto command =
      plant::static_gain(sum, {"position_output", "rate_disturbance"}, {"rate_command"});
  Eigen::MatrixXd difference(1, 2);
  difference << 1.0, -1.0;
  const auto error = plant::static_gain(difference, {"rate_command", "tachometer"}, {"rate_error"});
  const bool lag = law.structure == LoopStructure::pi_with_lag;
  std::vector<plant::StateSpace> parts{
      position, command, error,
      plant::rational({kr * wi, kr}, {0.0, 1.0}, "rate_error",
                      lag ? "unlagged_demand" : "valve_demand", "rate_integrator")};
  if (lag) {
    parts.push_back(plant::rational({1.0}, {1.0, 1.0 / gain(law, Gain::rate_lag)},
                                    "unlagged_demand", "valve_demand", "rate_lag"));
  }
  return plant::connect(parts, {"tachometer", "encoder", "rate_disturbance"},
                        {"valve_demand", "rate_command"});
}

}  // namespace boresight::control
