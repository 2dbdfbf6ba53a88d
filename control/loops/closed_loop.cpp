#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/eigenvalues.hpp>

namespace boresight::control {
namespace {

plant::StateSpace adder(const std::string& first, const std::string& second,
                        const std::string& sum) {
  return plant::static_gain(Eigen::MatrixXd::Ones(1, 2), {first, second}, {sum});
}

plant::StateSpace renamed(plant::StateSpace system, const std::string& from,
                          const std::string& to) {
  for (auto* names : {&system.inputs, &system.outputs}) {
    for (auto& name : *names) {
      if (name == from) name = to;
    }
  }
  return system;
}

// The plant seen at tachometer and motor torque, without the free angle: angles relative to the
// bull gear.
plant::StateSpace without_free_angle(const plant::AntennaPlant& antenna) {
  plant::StateSpace system = plant::to_state_space(antenna);
  const auto n = static_cast<Eigen::Index>(system.states.size());
  Eigen::Index bull = 0;
  Eigen::MatrixXd relative = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd absolute = relative;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (system.states[static_cast<std::size_t>(i)] == "bull_gear_angle") bull = i;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& name = system.states[static_cast<std::size_t>(i)];
    if (i != bull && name.ends_with("_angle")) {
      relative(i, bull) = -1.0;
      absolute(i, bull) = 1.0;
    }
  }
  const Eigen::MatrixXd a = relative * system.a * absolute;
  const Eigen::MatrixXd b = relative * system.b;
  const std::vector<Eigen::Index> seen{plant::output_index(system, "tachometer"),
                                       plant::output_index(system, "motor_torque")};
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i != bull) kept.push_back(i);
  }
  plant::StateSpace rate{a(kept, kept),
                         b(kept, Eigen::all),
                         system.c(seen, kept),
                         Eigen::MatrixXd::Zero(2, 2),
                         system.inputs,
                         {"tachometer", "motor_torque"},
                         {}};
  for (const Eigen::Index i : kept)
    rate.states.push_back(system.states[static_cast<std::size_t>(i)]);
  return rate;
}

plant::StateSpace rate_loop_alone(const plant::AntennaPlant& antenna, const Controller& controller,
                                  double delay) {
  return plant::connect({without_free_angle(antenna), rate_loop_controller(controller),
                         delay_approximant(delay, delay_order, "valve_demand", "valve_command")},
                        {"wind_torque"}, {"tachometer"});
}

// Exact: with the controller as it is sampled, its hold and its computation.
StabilityVerdict sampled_stability(const plant::AntennaPlant& antenna,
                                   const Controller& controller) {
  const double sample_time = controller.structure.state_space()->sample_time;
  const auto loop = sampled_loop(plant::to_state_space(antenna), controller, sample_time);
  StabilityVerdict verdict;
  verdict.closed_loop_abscissa =
      std::log(numerics::spectral_radius(sampled_closed_loop(loop).a)) / sample_time;
  verdict.rate_loop_abscissa = verdict.closed_loop_abscissa;
  return verdict;
}

LyapunovRms sampled_rms(const plant::AntennaPlant& antenna, const Controller& controller,
                        const plant::ShapingFilter& wind, const SensorNoise& noise) {
  const double sample_time = controller.structure.state_space()->sample_time;
  const auto windless = plant::to_state_space(antenna);
  const auto windy = plant::connect({windless, plant::to_state_space(wind, "wind_torque")},
                                    {"white_noise", "valve_command"}, windless.outputs);
  const auto rms_of = [&](const SampledLoopNoise& sources) {
    return sampled_loop_rms(sampled_loop(windy, controller, sample_time), sources, {"beam"})
        .over_time[0];
  };
  // The density of continuous noise, up to half the sampling rate.
  const double per_sample = 1.0 / (2.0 * sample_time * noise.bandwidth);
  const auto variance = [&](double rms) { return rms * rms * per_sample; };
  LyapunovRms rms;
  rms.wind = rms_of({.disturbance_intensity = {{"white_noise", 1.0}}, .measurement_variance = {}});
  SampledLoopNoise measured;
  measured.measurement_variance = {{"encoder", variance(noise.encoder_rms)},
                                   {"tachometer", variance(noise.tachometer_rms)}};
  if (controller.structure.feeds_torque_back()) {
    measured.measurement_variance["motor_torque"] = variance(noise.torque_rms);
  }
  rms.noise = rms_of(measured);
  rms.total = std::hypot(rms.wind, rms.noise);
  return rms;
}

}  // namespace

plant::StateSpace closed_loop(const plant::AntennaPlant& antenna, const Controller& controller,
                              double delay) {
  auto state_space = renamed(renamed(to_state_space(controller), "tachometer", "measured_rate"),
                             "encoder", "measured_angle");
  std::vector<plant::StateSpace> parts{
      plant::to_state_space(antenna), adder("tachometer", "tachometer_noise", "measured_rate"),
      adder("encoder", "encoder_noise", "measured_angle"),
      delay_approximant(delay, delay_order, "valve_demand", "valve_command")};
  std::vector<std::string> inputs{"wind_torque", "encoder_noise", "tachometer_noise",
                                  "rate_disturbance"};
  if (controller.structure.feeds_torque_back()) {
    state_space = renamed(state_space, "motor_torque", "measured_torque");
    parts.push_back(adder("motor_torque", "torque_noise", "measured_torque"));
    inputs.emplace_back("torque_noise");
  }
  parts.push_back(std::move(state_space));
  return plant::connect(parts, inputs,
                        {"beam", "encoder", "tachometer", "motor_torque", "valve_demand"});
}

StabilityVerdict stability(const plant::AntennaPlant& antenna, const Controller& controller,
                           double delay, const Eigen::ArrayXd& frequency) {
  if (controller.structure.state_space() != nullptr) return sampled_stability(antenna, controller);
  StabilityVerdict verdict;
  verdict.rate_loop_abscissa =
      numerics::spectral_abscissa(rate_loop_alone(antenna, controller, delay).a);
  verdict.closed_loop_abscissa =
      numerics::spectral_abscissa(closed_loop(antenna, controller, delay).a);
  const auto response = plant::plant_response(antenna, frequency);
  const auto approximant = delay_approximant(delay, delay_order, "in", "out");
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const double w = frequency[i];
    // Below a tenth of the dead time's corner the approximant is exact to working precision.
    if (w * delay < 0.1) continue;
    const std::complex<double> exact = std::polar(1.0, -w * delay);
    const std::complex<double> change =
        1.0 - plant::frequency_response(approximant, w)(0, 0) / exact;
    for (const auto loop_break : {LoopBreak::rate_loop_alone, LoopBreak::valve_command}) {
      const std::complex<double> loop =
          loop_gain(plant::point(response, i), w, controller, delay, loop_break);
      verdict.dead_time_residue =
          std::max(verdict.dead_time_residue, std::abs(change * loop / (1.0 + loop)));
    }
  }
  return verdict;
}

LyapunovRms lyapunov_rms(const plant::AntennaPlant& antenna, const Controller& controller,
                         double delay, const plant::ShapingFilter& wind, const SensorNoise& noise) {
  if (controller.structure.state_space() != nullptr) {
    return sampled_rms(antenna, controller, wind, noise);
  }
  const auto loop = closed_loop(antenna, controller, delay);
  LyapunovRms rms;
  {
    std::vector<std::string> inputs = loop.inputs;
    std::replace(inputs.begin(), inputs.end(), std::string("wind_torque"),
                 std::string("white_noise"));
    const auto driven =
        plant::connect({loop, plant::to_state_space(wind, "wind_torque")}, inputs, {"beam"});
    const Eigen::VectorXd b = driven.b.col(plant::input_index(driven, "white_noise"));
    const auto solution = solve_lyapunov(driven.a, b * b.transpose());
    rms.wind = std::sqrt((driven.c * solution.covariance * driven.c.transpose())(0, 0));
    rms.relative_residual = solution.relative_residual;
  }
  {
    // One-sided density sigma^2/bandwidth per Hz is an intensity of half that.
    Eigen::MatrixXd q = Eigen::MatrixXd::Zero(loop.a.rows(), loop.a.rows());
    std::vector<std::pair<const char*, double>> sources{{"encoder_noise", noise.encoder_rms},
                                                        {"tachometer_noise", noise.tachometer_rms}};
    if (controller.structure.feeds_torque_back())
      sources.emplace_back("torque_noise", noise.torque_rms);
    for (const auto& [name, value] : sources) {
      const Eigen::VectorXd b = loop.b.col(plant::input_index(loop, name));
      q += value * value / (2.0 * noise.bandwidth) * b * b.transpose();
    }
    const auto solution = solve_lyapunov(loop.a, q);
    const Eigen::RowVectorXd c = loop.c.row(plant::output_index(loop, "beam"));
    rms.noise = std::sqrt(c * solution.covariance * c.transpose());
    rms.relative_residual = std::max(rms.relative_residual, solution.relative_residual);
  }
  rms.total = std::hypot(rms.wind, rms.noise);
  return rms;
}

}  // namespace boresight::control
