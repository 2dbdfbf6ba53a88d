#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/antenna_in_wind.hpp>
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::design {
namespace {

// Places among SampledSetting::sensors().
constexpr Eigen::Index tachometer = 0, encoder = 1, motor_torque = 2;

Eigen::ArrayXXcd responses(const plant::StateSpace& system, const Eigen::ArrayXd& frequency,
                           Eigen::Index channels, bool of_inputs) {
  plant::DenseResponse dense(system);
  Eigen::ArrayXXcd result(frequency.size(), channels);
  Eigen::ArrayXcd channel;
  for (Eigen::Index i = 0; i < channels; ++i) {
    dense.evaluate(frequency, channel, of_inputs ? 0 : i, of_inputs ? i : 0);
    result.col(i) = channel;
  }
  return result;
}

// Fraction of the wind's torque that the torque's noise is where none is stated: controllers that
// feed torque back hear none then, and an LQG that hears so little is as good as without.
constexpr double min_torque_noise = 1e-3;

double wind_torque_rms(const plant::ShapingFilter& wind) {
  return control::h2_norm(plant::to_state_space(wind, "wind_torque")).value;
}

Eigen::MatrixXd steady_covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& jolts) {
  return control::solve_discrete_lyapunov(a, jolts, {.estimate_condition = false}).covariance;
}

}  // namespace

const std::vector<std::string>& SampledSetting::sensors() {
  static const std::vector<std::string> names{"tachometer", "encoder", "motor_torque"};
  return names;
}

plant::StateSpace from_sensors(const plant::StateSpace& controller) {
  const Eigen::Index output = plant::output_index(controller, "valve_command");
  const auto count = static_cast<Eigen::Index>(SampledSetting::sensors().size());
  plant::StateSpace result{controller.a,
                           Eigen::MatrixXd::Zero(controller.a.rows(), count),
                           controller.c.row(output),
                           Eigen::MatrixXd::Zero(1, count),
                           SampledSetting::sensors(),
                           {"valve_command"},
                           controller.states,
                           controller.sample_time};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto taken = std::ranges::find(controller.inputs,
                                         SampledSetting::sensors()[static_cast<std::size_t>(i)]);
    if (taken == controller.inputs.end()) continue;
    const auto column = taken - controller.inputs.begin();
    result.b.col(i) = controller.b.col(column);
    result.d(0, i) = controller.d(output, column);
  }
  return result;
}

SampledSetting::SampledSetting(std::string name, const plant::AntennaPlant& plant,
                               const plant::ShapingFilter& wind, const control::SensorNoise& noise,
                               double sample_time, Eigen::ArrayXd frequency, double encoder_gain)
    : name_(std::move(name)), plant_(plant), frequency_(std::move(frequency)) {
  problem_.plant = control::antenna_in_wind(plant, wind);
  problem_.plant.c.row(plant::output_index(problem_.plant, "encoder")) *= encoder_gain;
  problem_.commands = {"valve_command"};
  problem_.measured = SampledSetting::sensors();
  problem_.sample_time = problem_.computation_delay = sample_time;
  problem_.disturbance_intensity = {{"wind_white_noise", 1.0}};
  const double torque_rms =
      noise.torque_rms == 0.0 ? min_torque_noise * wind_torque_rms(wind) : noise.torque_rms;
  for (const auto& [sensor, rms] :
       {std::pair("tachometer", noise.tachometer_rms), std::pair("encoder", noise.encoder_rms),
        std::pair("motor_torque", torque_rms)}) {
    if (!(rms > 0.0)) {
      throw InvalidInput(
          fmt::format("pointing limit: expected noise of the {} above 0, found {}: state it, a "
                      "sensor without noise leaves nothing to estimate",
                      sensor, rms));
    }
    problem_.measurement_variance[sensor] =
        control::sample_variance(rms, noise.bandwidth, sample_time);
  }
  problem_.output_weight = {{"beam", 1.0}};
  problem_.command_weight = {{"valve_command", std::numeric_limits<double>::min()}};
  sampled_ = control::sampled_problem(problem_);
  response_ = responses(sampled_.plant, frequency_, sampled_.plant.c.rows(), false);
}

// States: those of the sampled plant, then the controller's.
struct SampledSetting::ClosedLoop {
  Eigen::MatrixXd a;
  Eigen::MatrixXd noise;       // of the sensors, into the states
  Eigen::RowVectorXd command;  // from the states
  Eigen::RowVectorXd direct;   // from the noise
};

SampledSetting::ClosedLoop SampledSetting::close(const plant::StateSpace& controller) const {
  const plant::StateSpace all_sensors = from_sensors(controller);
  const plant::StateSpace& plant = sampled_.plant;
  const Eigen::Index n = plant.a.rows(), m = all_sensors.a.rows();
  ClosedLoop loop;
  loop.direct = all_sensors.d;
  loop.command.resize(n + m);
  loop.command << all_sensors.d * plant.c, all_sensors.c;
  loop.a = Eigen::MatrixXd::Zero(n + m, n + m);
  loop.a.topLeftCorner(n, n) = plant.a;
  loop.a.topRows(n) += plant.b * loop.command;
  loop.a.bottomLeftCorner(m, n) = all_sensors.b * plant.c;
  loop.a.bottomRightCorner(m, m) = all_sensors.a;
  loop.noise.resize(n + m, plant.c.rows());
  loop.noise << plant.b * all_sensors.d, all_sensors.b;
  return loop;
}

double SampledSetting::spectral_radius(const plant::StateSpace& controller) const {
  return numerics::spectral_radius(close(controller).a);
}

Eigen::MatrixXd SampledSetting::wind_jolts(const ClosedLoop& loop) const {
  const Eigen::Index n = sampled_.plant.a.rows();
  Eigen::MatrixXd jolts = Eigen::MatrixXd::Zero(loop.a.rows(), loop.a.rows());
  jolts.topLeftCorner(n, n) = sampled_.process_covariance;
  return jolts;
}

Eigen::MatrixXd SampledSetting::noise_jolts(const ClosedLoop& loop) const {
  return loop.noise * sampled_.measurement_covariance * loop.noise.transpose();
}

// Over all time, but for what the wind does within a sample. The command's own noise is
// independent of the states that it meets.
double SampledSetting::boresight_variance(const ClosedLoop& loop, const Eigen::MatrixXd& covariance,
                                          double direct_variance) const {
  const Eigen::Index n = sampled_.plant.a.rows();
  const Eigen::VectorXd to_command = covariance * loop.command.transpose();
  return sampled_.q.cwiseProduct(covariance.topLeftCorner(n, n)).sum() +
         2.0 * sampled_.s.col(0).dot(to_command.head(n)) +
         sampled_.r(0, 0) * (loop.command.dot(to_command) + direct_variance);
}

SampledEvaluation SampledSetting::evaluate(const plant::StateSpace& controller) const {
  const ClosedLoop loop = close(controller);
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  SampledEvaluation result{0.0, nothing, nothing, nothing, nothing};
  result.spectral_radius = numerics::spectral_radius(loop.a);
  if (!(result.spectral_radius < 1.0 - 1e-12)) return result;
  const Eigen::MatrixXd wind = steady_covariance(loop.a, wind_jolts(loop));
  const Eigen::MatrixXd noise = steady_covariance(loop.a, noise_jolts(loop));
  const double direct =
      (loop.direct * sampled_.measurement_covariance * loop.direct.transpose())(0, 0);
  result.wind_rms = std::sqrt(boresight_variance(loop, wind, 0.0) + sampled_.unavoidable_cost);
  result.noise_rms = std::sqrt(boresight_variance(loop, noise, direct));
  result.boresight_rms = std::hypot(result.wind_rms, result.noise_rms);
  result.control_effort =
      std::sqrt((loop.command * noise * loop.command.transpose())(0, 0) + direct);
  return result;
}

double SampledSetting::boresight_rms(const plant::StateSpace& controller) const {
  const ClosedLoop loop = close(controller);
  const Eigen::MatrixXd both = steady_covariance(loop.a, wind_jolts(loop) + noise_jolts(loop));
  const double direct =
      (loop.direct * sampled_.measurement_covariance * loop.direct.transpose())(0, 0);
  return std::sqrt(boresight_variance(loop, both, direct) + sampled_.unavoidable_cost);
}

double SampledSetting::control_effort(const plant::StateSpace& controller) const {
  const ClosedLoop loop = close(controller);
  const Eigen::MatrixXd noise = steady_covariance(loop.a, noise_jolts(loop));
  return std::sqrt((loop.command * noise * loop.command.transpose())(0, 0) +
                   (loop.direct * sampled_.measurement_covariance * loop.direct.transpose())(0, 0));
}

ControllerGramians SampledSetting::controller_gramians(const plant::StateSpace& controller,
                                                       double command_weight) const {
  const ClosedLoop loop = close(controller);
  const Eigen::Index n = sampled_.plant.a.rows(), m = loop.a.rows() - n;
  const Eigen::MatrixXd covariance =
      steady_covariance(loop.a, wind_jolts(loop) + noise_jolts(loop));
  Eigen::MatrixXd cost =
      (sampled_.r(0, 0) + command_weight) * loop.command.transpose() * loop.command;
  cost.topLeftCorner(n, n) += sampled_.q;
  const Eigen::MatrixXd mixed = sampled_.s.col(0) * loop.command;
  cost.topRows(n) += mixed;
  cost.leftCols(n) += mixed.transpose();
  const Eigen::MatrixXd to_go = steady_covariance(loop.a.transpose(), cost);
  return {covariance.bottomRightCorner(m, m), to_go.bottomRightCorner(m, m)};
}

Eigen::ArrayXXcd SampledSetting::controller_response(const plant::StateSpace& controller,
                                                     const Eigen::ArrayXd& frequency) {
  return responses(from_sensors(controller), frequency,
                   static_cast<Eigen::Index>(SampledSetting::sensors().size()), true);
}

SampledPeak SampledSetting::highest_peak(const Eigen::ArrayXXcd& controller_response) const {
  return highest_of(Eigen::ArrayXcd::Ones(frequency_.size()),
                    1.0 - (controller_response * response_).rowwise().sum());
}

// S = (1 + L of the other sensors) / (1 + L of all).
SampledPeak SampledSetting::highest_position_peak(
    const Eigen::ArrayXXcd& controller_response) const {
  const Eigen::ArrayXcd others = inner_return_difference(response_, controller_response);
  return highest_of(others, others - controller_response.col(encoder) * response_.col(encoder));
}

SampledPeak SampledSetting::highest_locked_motor_gain(
    const Eigen::ArrayXXcd& controller_response) const {
  return highest_of(controller_response.col(encoder) * response_.col(motor_torque),
                    inner_return_difference(response_, controller_response));
}

// The return difference is as smooth as plant and controller are, its inverse is not: numerator and
// denominator are interpolated over ln w, by polynomials through five points.
SampledPeak SampledSetting::highest_of(const Eigen::ArrayXcd& numerator,
                                       const Eigen::ArrayXcd& denominator) const {
  constexpr Eigen::Index nodes = 5;
  // Of ln: a local maximum on the grid that is lower by more is not the highest between either.
  constexpr double contending = 0.1;
  const Eigen::ArrayXd level = (numerator / denominator).abs().log();
  Eigen::Index top = 0;
  const double on_grid = level.maxCoeff(&top);
  SampledPeak highest{frequency_[top], on_grid};
  if (level.size() < nodes) return {highest.frequency, std::exp(highest.magnitude)};
  for (Eigen::Index k = 1; k + 1 < level.size(); ++k) {
    if (level[k] < level[k - 1] || level[k] < level[k + 1]) continue;
    if (level[k] < on_grid - contending) continue;
    const Eigen::Index first = std::clamp(k - nodes / 2, Eigen::Index{0}, level.size() - nodes);
    const Eigen::Array<double, nodes, 1> places =
        (frequency_.segment<nodes>(first) / frequency_[k]).log();
    const auto between = [&](double place) {
      std::complex<double> above = 0.0, below = 0.0;
      for (Eigen::Index i = 0; i < nodes; ++i) {
        double weight = 1.0;  // Lagrange's
        for (Eigen::Index j = 0; j < nodes; ++j) {
          if (j != i) weight *= (place - places[j]) / (places[i] - places[j]);
        }
        above += weight * numerator[first + i];
        below += weight * denominator[first + i];
      }
      return std::log(std::abs(above / below));
    };
    const double place =
        numerics::bracketed_maximum(between, places[k - 1 - first], places[k + 1 - first]);
    const double found = between(place);
    if (found > highest.magnitude) highest = {frequency_[k] * std::exp(place), found};
  }
  return {highest.frequency, std::exp(highest.magnitude)};
}

Eigen::ArrayXcd inner_return_difference(const Eigen::ArrayXXcd& plant,
                                        const Eigen::ArrayXXcd& controller) {
  return 1.0 - controller.col(tachometer) * plant.col(tachometer) -
         controller.col(motor_torque) * plant.col(motor_torque);
}

}  // namespace boresight::design
