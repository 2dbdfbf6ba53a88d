#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/covariance_propagation.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using Names = std::vector<std::string>;

bool has(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Inputs of the controller, those that are outputs of the plant or the others.
Names controller_inputs(const SampledLoop& loop, bool measured) {
  Names result;
  std::copy_if(loop.controller.inputs.begin(), loop.controller.inputs.end(),
               std::back_inserter(result),
               [&](const std::string& name) { return has(loop.plant.outputs, name) == measured; });
  return result;
}

// Inputs of the plant that the controller does not drive.
Names disturbances(const SampledLoop& loop) {
  Names result;
  std::copy_if(loop.plant.inputs.begin(), loop.plant.inputs.end(), std::back_inserter(result),
               [&](const std::string& name) { return !has(loop.controller.outputs, name); });
  return result;
}

void check(const char* function, const SampledLoop& loop) {
  plant::validate(loop.plant);
  plant::validate(loop.controller);
  if (loop.plant.sample_time != 0.0 || !(loop.controller.sample_time > 0.0)) {
    throw InvalidInput(
        fmt::format("{}: expected a continuous plant and a sampled controller, found sample times "
                    "of {} s and {} s",
                    function, loop.plant.sample_time, loop.controller.sample_time));
  }
  for (const auto& command : loop.controller.outputs) {
    if (!has(loop.plant.inputs, command)) {
      throw InvalidInput(
          fmt::format("{}: expected the controller's outputs among the plant's inputs {}, found "
                      "'{}'",
                      function, fmt::join(loop.plant.inputs, ", "), command));
    }
  }
  if (controller_inputs(loop, true).empty()) {
    throw InvalidInput(fmt::format(
        "{}: none of the controller's inputs {} is one of the plant's outputs {}", function,
        fmt::join(loop.controller.inputs, ", "), fmt::join(loop.plant.outputs, ", ")));
  }
  if (!(loop.computation_delay >= 0.0)) {
    throw InvalidInput(fmt::format("{}: expected a computation_delay of 0 or more, found {} s",
                                   function, loop.computation_delay));
  }
}

// The plant seen from the samples, commands held and delayed.
plant::StateSpace sampled_plant(const SampledLoop& loop) {
  plant::SamplingOptions options;
  for (const auto& input : loop.plant.inputs) {
    options.dead_times.push_back(has(loop.controller.outputs, input) ? loop.computation_delay
                                                                     : 0.0);
  }
  return plant::sample(loop.plant, loop.controller.sample_time,
                       plant::SamplingMethod::zero_order_hold, options);
}

void append(Names& names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
}

}  // namespace

plant::StateSpace sampled_closed_loop(const SampledLoop& loop) {
  check("sampled_closed_loop", loop);
  const Names measured = controller_inputs(loop, true);
  std::vector<plant::StateSpace> parts{sampled_plant(loop)};
  std::map<std::string, std::string> with_noise;
  Names inputs = disturbances(loop);
  append(inputs, controller_inputs(loop, false));
  for (const auto& output : measured) {
    with_noise[output] = output + "_measured";
    inputs.push_back(output + "_noise");
    parts.push_back(plant::static_gain(Eigen::MatrixXd::Ones(1, 2), {output, output + "_noise"},
                                       {output + "_measured"}));
  }
  parts.push_back(plant::renamed(loop.controller, with_noise));
  Names outputs = loop.plant.outputs;
  append(outputs, loop.controller.outputs);
  return plant::connect(parts, inputs, outputs);
}

plant::StateSpace sampled_open_loop(const SampledLoop& loop, std::string_view command) {
  check("sampled_open_loop", loop);
  const std::string cut(command);
  if (!has(loop.controller.outputs, cut)) {
    throw InvalidInput(fmt::format("sampled_open_loop: expected a command among {}, found '{}'",
                                   fmt::join(loop.controller.outputs, ", "), cut));
  }
  const auto answer = plant::renamed(loop.controller, {{cut, cut + "_answered"}});
  const auto negative =
      plant::static_gain(-Eigen::MatrixXd::Ones(1, 1), {cut + "_answered"}, {cut + "_returned"});
  Names inputs = disturbances(loop);
  append(inputs, controller_inputs(loop, false));
  inputs.push_back(cut);
  return plant::subsystem(
      plant::connect({sampled_plant(loop), answer, negative}, inputs, {cut + "_returned"}), {cut},
      {cut + "_returned"});
}

namespace {

// Columns of B, one for each noise, times the root of its intensity or variance.
Eigen::MatrixXd weighted_columns(const char* what, const Names& among, const Eigen::MatrixXd& b,
                                 const std::map<std::string, double>& weights) {
  Eigen::MatrixXd result(b.rows(), static_cast<Eigen::Index>(weights.size()));
  Eigen::Index column = 0;
  for (const auto& [name, weight] : weights) {
    const auto found = std::find(among.begin(), among.end(), name);
    if (found == among.end()) {
      throw InvalidInput(fmt::format("sampled_loop_rms: expected a {} of one of {}, found '{}'",
                                     what, fmt::join(among, ", "), name));
    }
    if (!(weight >= 0.0) || !std::isfinite(weight)) {
      throw InvalidInput(fmt::format(
          "sampled_loop_rms: expected a {} of 0 or more, found {} of '{}'", what, weight, name));
    }
    result.col(column++) = std::sqrt(weight) * b.col(found - among.begin());
  }
  return result;
}

// The plant's states, the command before and the command after it arrives, as [closed loop's
// states, measurement noises] give them at a sample.
struct StartOfPeriod {
  Eigen::MatrixXd from_states;
  Eigen::MatrixXd from_noises;
};

StartOfPeriod start_of_period(const SampledLoop& loop, const plant::StateSpace& closed,
                              const Eigen::MatrixXd& noise_to_commands,
                              const plant::DeadTimeInSamples& late) {
  const Eigen::Index n = loop.plant.a.rows();
  const auto m = static_cast<Eigen::Index>(loop.controller.outputs.size());
  StartOfPeriod result{Eigen::MatrixXd::Zero(n + 2 * m, closed.a.rows()),
                       Eigen::MatrixXd::Zero(n + 2 * m, noise_to_commands.cols())};
  result.from_states.topLeftCorner(n, n).setIdentity();
  for (Eigen::Index j = 0; j < m; ++j) {
    const std::string& command = loop.controller.outputs[static_cast<std::size_t>(j)];
    // The command of `ago` samples ago to the row of the start.
    const auto put = [&](Eigen::Index row, Eigen::Index ago) {
      if (ago == 0) {
        const Eigen::Index output = plant::output_index(closed, command);
        result.from_states.row(row) = closed.c.row(output);
        result.from_noises.row(row) = noise_to_commands.row(j);
        return;
      }
      const auto held = std::find(closed.states.begin(), closed.states.end(),
                                  fmt::format("{}_held_{}", command, ago));
      result.from_states(row, held - closed.states.begin()) = 1.0;
    };
    if (late.rest > 0.0) put(n + j, late.samples + 1);
    put(n + m + j, late.samples);
  }
  return result;
}

}  // namespace

SampledLoopRms sampled_loop_rms(const SampledLoop& loop, const SampledLoopNoise& noise,
                                const Names& outputs) {
  check("sampled_loop_rms", loop);
  const plant::StateSpace closed = sampled_closed_loop(loop);
  const auto commands = plant::subsystem(loop.plant, loop.controller.outputs, outputs);
  const Names measured = controller_inputs(loop, true);
  const Eigen::Index n = loop.plant.a.rows();
  const auto m = static_cast<Eigen::Index>(loop.controller.outputs.size());

  // Disturbances: continuous, into the plant.
  const Names free_inputs = disturbances(loop);
  const auto disturbed = plant::subsystem(loop.plant, free_inputs, loop.plant.outputs);
  const Eigen::MatrixXd drive = weighted_columns("disturbance_intensity", free_inputs, disturbed.b,
                                                 noise.disturbance_intensity);
  const Eigen::MatrixXd direct = weighted_columns("disturbance_intensity", free_inputs, disturbed.d,
                                                  noise.disturbance_intensity);
  for (std::size_t i = 0; i < loop.plant.outputs.size(); ++i) {
    const std::string& output = loop.plant.outputs[i];
    if (direct.row(static_cast<Eigen::Index>(i)).isZero(0.0)) continue;
    if (has(outputs, output) || has(measured, output)) {
      throw InvalidInput(fmt::format(
          "sampled_loop_rms: white noise reaches the output '{}' without a lag, so that "
          "its variance is infinite; put the filter that there is into the plant",
          output));
    }
  }
  // Noise of the samples.
  Names noise_inputs;
  for (const auto& output : measured) noise_inputs.push_back(output + "_noise");
  const auto sampled = plant::subsystem(closed, noise_inputs, closed.outputs);
  const Eigen::MatrixXd jolt =
      weighted_columns("measurement_variance", measured, sampled.b, noise.measurement_variance);
  const Eigen::MatrixXd jolt_direct =
      weighted_columns("measurement_variance", measured, sampled.d, noise.measurement_variance);

  // Steady state at the samples.
  const double period = loop.controller.sample_time;
  const Eigen::MatrixXd intensity = drive * drive.transpose();
  Eigen::MatrixXd per_sample = jolt * jolt.transpose();
  per_sample.topLeftCorner(n, n) +=
      plant::propagate_covariance(loop.plant.a, intensity, Eigen::MatrixXd::Zero(n, n), period).end;
  const Eigen::MatrixXd covariance =
      solve_discrete_lyapunov(closed.a, per_sample, {.estimate_condition = false}).covariance;

  // Through a period: states, the command that still acts, the command that is to come.
  const plant::DeadTimeInSamples late = plant::dead_time_in_samples(loop.computation_delay, period);
  const StartOfPeriod begin = start_of_period(loop, closed, jolt_direct.bottomRows(m), late);
  const Eigen::Index all = n + 2 * m;
  Eigen::MatrixXd joint_intensity = Eigen::MatrixXd::Zero(all, all);
  joint_intensity.topLeftCorner(n, n) = intensity;
  Eigen::MatrixXd joint = begin.from_states * covariance * begin.from_states.transpose() +
                          begin.from_noises * begin.from_noises.transpose();
  Eigen::VectorXd mean_square = Eigen::VectorXd::Zero(commands.c.rows());
  const auto pass = [&](Eigen::Index acting, double time) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(all, all);
    a.topLeftCorner(n, n) = loop.plant.a;
    a.block(0, acting, n, m) = commands.b;
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(commands.c.rows(), all);
    c.leftCols(n) = commands.c;
    c.middleCols(acting, m) = commands.d;
    const auto through = plant::propagate_covariance(a, joint_intensity, joint, time);
    mean_square += time / period * (c * through.mean * c.transpose()).diagonal();
    joint = through.end;
  };
  if (late.rest > 0.0) pass(n, late.rest);
  pass(n + m, period - late.rest);

  SampledLoopRms result{outputs, Eigen::VectorXd(commands.c.rows()), mean_square.cwiseSqrt()};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Eigen::Index row = plant::output_index(closed, outputs[i]);
    const Eigen::RowVectorXd c = closed.c.row(row);
    result.at_samples[static_cast<Eigen::Index>(i)] =
        std::sqrt((c * covariance * c.transpose())(0, 0) + jolt_direct.row(row).squaredNorm());
  }
  return result;
}

}  // namespace boresight::control
