#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/command_loop.hpp>
#include <boresight/design/commissioning/commissioning_check.hpp>
#include <boresight/design/commissioning/sampled_step.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/point_response.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::design {
namespace {

using control::LoopBreak;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Eigen::Index samples_watched = 6000;

TrackingProblem with_plant(TrackingProblem problem, const plant::AntennaPlant& plant) {
  problem.plant = plant;
  problem.points_per_decade = 60;
  return problem;
}

// Trapezoidal weights in Hz on a grid in rad/s, nothing beyond `highest` Hz.
Eigen::ArrayXd weights(const Eigen::ArrayXd& frequency, double highest) {
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(frequency.size());
  for (Eigen::Index i = 1; i < frequency.size(); ++i) {
    const double turn = two_pi;
    const double from = std::min(frequency[i - 1] / turn, highest);
    const double to = std::min(frequency[i] / turn, highest);
    weight[i - 1] += 0.5 * (to - from);
    weight[i] += 0.5 * (to - from);
  }
  return weight;
}

// The plant as its sensors show it.
plant::StateSpace sensed(plant::StateSpace system, const SignalFactors& factors) {
  const auto scale = [&](std::string_view output, double factor) {
    const Eigen::Index row = plant::output_index(system, output);
    system.c.row(row) *= factor;
    system.d.row(row) *= factor;
  };
  scale("tachometer", factors.tachometer);
  scale("motor_torque", factors.torque);
  scale("encoder", factors.encoder);
  const Eigen::Index valve = plant::input_index(system, "valve_command");
  system.b.col(valve) *= factors.valve;
  system.d.col(valve) *= factors.valve;
  return system;
}

// One frequency of a stage's loop, dead time included.
struct StagePoint {
  plant::ResponsePoint plant;
  std::complex<double> rate, outer, torque_path, loop;
};

StagePoint stage_point(const StageController& stage, plant::ResponsePoint plant, double frequency,
                       double delay) {
  const std::complex<double> late = std::polar(1.0, -frequency * delay);
  for (auto* one : {&plant.tachometer_command, &plant.torque_command, &plant.encoder_command}) {
    *one *= late;
  }
  auto controller = control::compensator_response(stage.controller, frequency);
  if (stage.position_open) controller.position = 0.0;
  // u = R (r - tachometer) - Q torque, r = -P (encoder - C torque).
  StagePoint point;
  point.plant = plant;
  point.rate = controller.rate;
  point.outer = controller.rate * controller.position;
  point.torque_path = controller.pressure - point.outer * controller.compliance;
  point.loop = 1.0 + point.rate * plant.tachometer_command +
               point.torque_path * plant.torque_command + point.outer * plant.encoder_command;
  return point;
}

}  // namespace

bool SignalFactors::as_stated() const {
  return valve == 1.0 && tachometer == 1.0 && torque == 1.0 && encoder == 1.0;
}

StageObserver::StageObserver(const TrackingProblem& problem, const plant::AntennaPlant& plant,
                             const WindTable& wind, const CommandedMove& move,
                             const SignalFactors& factors)
    : problem_(with_plant(problem, plant)),
      stated_(problem.plant),
      move_(move),
      factors_(factors),
      sensed_(sensed(plant::to_state_space(plant), factors)),
      evaluator_(make_adaptive_evaluator(problem_, wind)) {
  const bool moves = move.rate > 0.0 && move.acceleration > 0.0;
  if (!moves) {
    throw InvalidInput(
        fmt::format("StageObserver: expected a move of positive rate and "
                    "acceleration, found {} rad/s and {} rad/s2",
                    move.rate, move.acceleration));
  }
  const Eigen::ArrayXd frequency = analysis_grid(problem_);
  response_ = sensed_response(frequency);
  wind_spectrum_ = motor_wind_spectrum(problem_, frequency);
}

plant::PlantResponse StageObserver::sensed_response(const Eigen::ArrayXd& frequency) const {
  plant::PlantResponse response = plant::plant_response(problem_.plant, frequency);
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    plant::ResponsePoint point = plant::point(response, i);
    point.tachometer_command *= factors_.valve * factors_.tachometer;
    point.torque_command *= factors_.valve * factors_.torque;
    point.encoder_command *= factors_.valve * factors_.encoder;
    point.boresight_command *= factors_.valve;
    point.tachometer_wind *= factors_.tachometer;
    point.torque_wind *= factors_.torque;
    point.encoder_wind *= factors_.encoder;
    plant::set_point(response, i, point);
  }
  return response;
}

plant::StateSpace StageObserver::command_loop(const StageController& stage) const {
  return stage.position_open
             ? control::rate_command_loop(sensed_, stage.controller, problem_.delay)
             : control::position_command_loop(sensed_, stage.controller, problem_.delay);
}

Eigen::ArrayXcd StageObserver::response(const StageController& stage,
                                        const Eigen::ArrayXd& frequency) const {
  const plant::PlantResponse plant = sensed_response(frequency);
  Eigen::ArrayXcd closed(frequency.size());
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const StagePoint point =
        stage_point(stage, plant::point(plant, i), frequency[i], problem_.delay);
    closed[i] = (stage.position_open ? point.rate * point.plant.tachometer_command
                                     : point.outer * point.plant.encoder_command) /
                point.loop;
  }
  return closed;
}

double StageObserver::peak(const StageController& stage) {
  const auto evaluation = evaluator_.evaluate(stage.controller, false);
  if (evaluation.unstable_rate_loop > 0) return infinity;
  double largest = evaluation.highest_peak(LoopBreak::rate_loop_alone);
  if (stage.position_open) return largest;
  if (evaluation.unstable_closed_loop > 0) return infinity;
  for (const auto loop_break : {LoopBreak::valve_command, LoopBreak::position_loop}) {
    largest = std::max(largest, evaluation.highest_peak(loop_break));
  }
  return largest;
}

double StageObserver::crossover(const StageController& stage) const {
  const auto loop_break =
      stage.position_open ? LoopBreak::rate_loop_alone : LoopBreak::position_loop;
  double before = 0.0;
  for (Eigen::Index i = 0; i < response_.frequency.size(); ++i) {
    const double gain =
        std::log(std::abs(control::loop_gain(plant::point(response_, i), response_.frequency[i],
                                             stage.controller, problem_.delay, loop_break)));
    if (i > 0 && before >= 0.0 && gain < 0.0) {
      const double from = std::log(response_.frequency[i - 1]);
      const double to = std::log(response_.frequency[i]);
      return std::exp(from + (to - from) * before / (before - gain));
    }
    before = gain;
  }
  return no_number;
}

void StageObserver::observe_step(const StageController& stage, StageObservation& seen) const {
  const plant::StateSpace loop = command_loop(stage);
  const double step = 60.0 / (seen.crossover * static_cast<double>(samples_watched));
  Eigen::MatrixXd input =
      Eigen::MatrixXd::Zero(samples_watched, static_cast<Eigen::Index>(loop.inputs.size()));
  input.col(0).setOnes();
  plant::LinearSimulation simulation(loop, step);
  const Eigen::MatrixXd output = simulation.simulate(input);
  const Eigen::VectorXd response = output.col(0);
  seen.rise_time = rise_time(response, step);
  seen.overshoot = std::max(0.0, response.maxCoeff() - 1.0);
  const Eigen::Index settled = settled_from(response);
  seen.settling_time = settled < response.size() ? step * static_cast<double>(settled) : infinity;
  seen.largest_torque = output.col(1).cwiseAbs().maxCoeff();
  seen.largest_demand = output.col(2).cwiseAbs().maxCoeff();
}

void StageObserver::observe_move(const StageController& stage, StageObservation& seen) const {
  const plant::StateSpace loop =
      control::position_command_loop(sensed_, stage.controller, problem_.delay);
  const auto forward = stage.feedforward
                           ? control::plant_feedforward(stated_, stage.controller, problem_.delay)
                           : control::Feedforward{};
  // Speeding up, as long at the rate, slowing down, and time for what is left to show.
  const double ramp = move_.rate / move_.acceleration;
  const double wait = 30.0 / seen.crossover;
  const double step = (3.0 * ramp + 2.0 * wait) / static_cast<double>(samples_watched);
  const auto inputs = static_cast<Eigen::Index>(loop.inputs.size());
  constexpr Eigen::Index torque = 4;  // of a state space that reads it
  Eigen::MatrixXd input = Eigen::MatrixXd::Zero(samples_watched, inputs);
  for (Eigen::Index k = 0; k < samples_watched; ++k) {
    const double t = step * static_cast<double>(k);
    const double end = 2.0 * ramp + wait;
    const double up = std::clamp(t, 0.0, ramp);
    const double down = std::clamp(t - end, 0.0, ramp);
    const double rate = move_.acceleration * (up - down);
    const double acceleration =
        move_.acceleration * ((t < ramp ? 1.0 : 0.0) - (t >= end && t < end + ramp ? 1.0 : 0.0));
    input(k, 0) = move_.acceleration * (0.5 * up * up + ramp * std::max(0.0, t - ramp) -
                                        0.5 * down * down - ramp * std::max(0.0, t - end - ramp));
    input(k, 1) =
        forward.rate_to_rate_command * rate + forward.acceleration_to_rate_command * acceleration;
    input(k, 2) =
        forward.rate_to_valve_command * rate + forward.acceleration_to_valve_command * acceleration;
    if (inputs > torque) {
      input(k, torque) =
          forward.rate_to_motor_torque * rate + forward.acceleration_to_motor_torque * acceleration;
    }
  }
  plant::LinearSimulation simulation(loop, step,
                                     {.interpolation = plant::Interpolation::first_order_hold});
  const Eigen::MatrixXd output = simulation.simulate(input);
  seen.move_error = (input.col(0) - output.col(0)).cwiseAbs().maxCoeff();
}

void StageObserver::observe_recorder(const StageController& stage, StageObservation& seen) const {
  const auto& noise = problem_.noise;
  const Eigen::ArrayXd& frequency = response_.frequency;
  const Eigen::ArrayXd noise_weight = weights(frequency, noise.bandwidth);
  const std::array<double, 3> densities{std::pow(noise.encoder_rms, 2) / noise.bandwidth,
                                        std::pow(noise.tachometer_rms, 2) / noise.bandwidth,
                                        std::pow(noise.torque_rms, 2) / noise.bandwidth};
  // Encoder error, tachometer, torque, valve command.
  std::array<double, 4> calm{};
  std::array<double, 4> windy{};
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const double w = frequency[i];
    const auto [plant, rate, outer, torque_path, loop] =
        stage_point(stage, plant::point(response_, i), w, problem_.delay);
    const std::array<std::complex<double>, 3> to_valve{-outer / loop, -rate / loop,
                                                       -torque_path / loop};
    for (std::size_t source = 0; source < 3; ++source) {
      const auto u = to_valve[source];
      const double power = densities[source] * noise_weight[i];
      calm[0] += power * std::norm(plant.encoder_command * u + (source == 0 ? 1.0 : 0.0));
      calm[1] += power * std::norm(plant.tachometer_command * u + (source == 1 ? 1.0 : 0.0));
      calm[2] += power * std::norm(plant.torque_command * u + (source == 2 ? 1.0 : 0.0));
      calm[3] += power * std::norm(u) * control::sample_density(stage.controller, w);
    }
    const std::complex<double> by_wind =
        -(rate * plant.tachometer_wind + torque_path * plant.torque_wind +
          outer * plant.encoder_wind) /
        loop;
    const double power = wind_spectrum_[i] * noise_weight[i];
    windy[0] += power * std::norm(plant.encoder_wind + plant.encoder_command * by_wind);
    windy[1] += power * std::norm(plant.tachometer_wind + plant.tachometer_command * by_wind);
    windy[2] += power * std::norm(plant.torque_wind + plant.torque_command * by_wind);
    windy[3] += power * std::norm(by_wind) * control::sample_density(stage.controller, w);
  }
  const auto rms = [](const std::array<double, 4>& power) {
    return RecordedRms{std::sqrt(power[0]), std::sqrt(power[1]), std::sqrt(power[2]),
                       std::sqrt(power[3])};
  };
  seen.calm = rms(calm);
  for (std::size_t k = 0; k < windy.size(); ++k) windy[k] += calm[k];
  seen.windy = rms(windy);
  if (stage.position_open) seen.calm.encoder_error = seen.windy.encoder_error = no_number;
}

// The free angle that nothing holds with the position loop open is no instability, nor is rounding.
StageObserver::Verdict StageObserver::verdict_by_command_loop(const StageController& stage) const {
  constexpr double rounding = 1e-6;  // 1/s
  Verdict result;
  result.abscissa = numerics::spectral_abscissa(command_loop(stage).a);
  result.peak = no_number;
  result.stable = result.abscissa < rounding;
  return result;
}

StageObserver::Verdict StageObserver::verdict(const StageController& stage) {
  if (!factors_.as_stated()) return verdict_by_command_loop(stage);
  const auto by_eigenvalues =
      control::stability(problem_.plant, stage.controller, problem_.delay, response_.frequency);
  Verdict result;
  result.peak = peak(stage);
  // The residue is of both loops: of an open one only the encirclements are compared with the
  // eigenvalues.
  result.abscissa = stage.position_open ? by_eigenvalues.rate_loop_abscissa
                                        : std::max(by_eigenvalues.rate_loop_abscissa,
                                                   by_eigenvalues.closed_loop_abscissa);
  result.stable = result.abscissa < 0.0 && std::isfinite(result.peak) &&
                  (stage.position_open || by_eigenvalues.dead_time_residue < 1.0);
  return result;
}

StageObservation StageObserver::observe(const StageController& stage) {
  StageObservation seen;
  const Verdict found = verdict(stage);
  seen.abscissa = found.abscissa;
  seen.peak = found.peak;
  seen.stable = found.stable;
  seen.crossover = seen.stable ? crossover(stage) : no_number;
  seen.boresight_rms = seen.move_error = no_number;
  if (!seen.stable || !(seen.crossover > 0.0)) {
    seen.crossover = seen.rise_time = seen.overshoot = seen.settling_time = no_number;
    seen.largest_demand = seen.largest_torque = seen.valve_per_rate = seen.oil_stiffness =
        no_number;
    seen.calm = seen.windy = {no_number, no_number, no_number, no_number};
    return seen;
  }
  observe_step(stage, seen);
  observe_recorder(stage, seen);
  const plant::Drive& drive = problem_.plant.drive;
  seen.valve_per_rate = (1.0 + drive.leakage_rate * drive.viscous_friction / drive.oil_stiffness) /
                        (factors_.valve * factors_.tachometer);
  seen.oil_stiffness = drive.oil_stiffness * factors_.torque / factors_.tachometer;
  if (!stage.position_open) observe_move(stage, seen);
  if (!factors_.as_stated()) {
    seen.windy = {no_number, no_number, no_number, no_number};
  } else if (!stage.position_open) {
    seen.boresight_rms =
        std::sqrt(evaluator_.evaluate(stage.controller, false).boresight_variance());
  }
  return seen;
}

}  // namespace boresight::design
