#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/antenna_in_wind.hpp>
#include <boresight/design/benchmark/rejection_response.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/gauss_rule.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::design {
namespace {

constexpr int order_of_delay = 8;

std::vector<std::string> measured_by(const plant::StateSpace& controller) {
  std::vector<std::string> names = controller.inputs;
  std::erase(names, "rate_disturbance");
  return names;
}

plant::StateSpace demand_only(const plant::StateSpace& controller) {
  const auto antenna_form = control::antenna_state_space_controller(controller);
  return plant::subsystem(antenna_form, measured_by(antenna_form), {"valve_demand"});
}

// The demand to the valve.
plant::StateSpace delayed(double delay) {
  if (delay > 0.0) {
    return control::delay_approximant(delay, order_of_delay, "valve_demand", "valve_command");
  }
  return plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"valve_demand"}, {"valve_command"});
}

// Points of a grid's intervals.
struct Quadrature {
  Eigen::ArrayXd frequency, weight;  // weight: of an integral over Hz
};
Quadrature three_between(const std::vector<double>& edges) {
  const numerics::GaussRule gauss = numerics::gauss_rule(3);
  const auto panels = static_cast<Eigen::Index>(edges.size()) - 1;
  Quadrature rule{Eigen::ArrayXd(3 * panels), Eigen::ArrayXd(3 * panels)};
  for (Eigen::Index i = 0; i < panels; ++i) {
    const double from = std::log(edges[static_cast<std::size_t>(i)]);
    const double half = 0.5 * (std::log(edges[static_cast<std::size_t>(i) + 1]) - from);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto point = static_cast<std::size_t>(k);
      const double frequency = std::exp(from + half * (1.0 + gauss.node[point]));
      rule.frequency[3 * i + k] = frequency;
      rule.weight[3 * i + k] = half * gauss.weight[point] * frequency / two_pi;
    }
  }
  return rule;
}

double variance(double rms, double bandwidth, const Eigen::ArrayXd& square,
                const Eigen::ArrayXd& weight) {
  return rms * rms / bandwidth * (square * weight).sum();
}

}  // namespace

Eigen::VectorXcd controlled_poles(const plant::AntennaPlant& antenna,
                                  const plant::StateSpace& controller, double delay) {
  const auto antenna_form = demand_only(controller);
  const auto plant_part = plant::to_state_space(antenna);
  if (antenna_form.sample_time > 0.0) {
    const control::SampledLoop loop{
        plant_part, plant::renamed(antenna_form, {{"valve_demand", "valve_command"}}),
        antenna_form.sample_time};
    return plant::continuous_equivalent(numerics::eigenvalues(control::sampled_closed_loop(loop).a),
                                        antenna_form.sample_time);
  }
  const auto closed =
      plant::connect({plant_part, antenna_form, delayed(delay)}, {"wind_torque"}, {"beam"});
  return numerics::eigenvalues(closed.a);
}

RejectionResponse rejection_response(const TrackingProblem& problem,
                                     const plant::StateSpace& controller) {
  control::ControlledAntenna loop(problem.plant, controller, problem.delay);
  const bool sampled = controller.sample_time > 0.0;
  const control::FrequencyBand analysis = analysis_band(problem);
  const double nyquist = loop.nyquist_frequency() / two_pi;
  const control::FrequencyBand band = problem.rms_band;
  const double noise_end = sampled ? nyquist : std::min(problem.noise.bandwidth, band.highest);
  const double lowest = std::min(analysis.lowest, band.lowest);
  const double highest = std::max({analysis.highest, band.highest, noise_end});

  const Eigen::VectorXcd closed = controlled_poles(problem.plant, controller, problem.delay);
  const Eigen::VectorXcd open = numerics::eigenvalues(plant::to_state_space(problem.plant).a);
  std::vector<std::complex<double>> features;
  for (const auto& poles : {closed, open}) {
    std::ranges::copy_if(poles, std::back_inserter(features), [](std::complex<double> pole) {
      return std::isfinite(std::abs(pole)) && std::abs(pole) > 1e-9;
    });
  }
  const Eigen::VectorXcd all = Eigen::Map<const Eigen::VectorXcd>(
      features.data(), static_cast<Eigen::Index>(features.size()));
  constexpr int points_per_decade = 30;
  const Eigen::ArrayXd grid = plant::response_grid(all, 0.0,
                                                   {.lowest = two_pi * lowest,
                                                    .highest = two_pi * highest,
                                                    .points_per_decade = points_per_decade});
  std::vector<double> edges(grid.begin(), grid.end());
  for (const double edge : {band.lowest, band.highest, noise_end}) edges.push_back(two_pi * edge);
  std::ranges::sort(edges);
  const auto same = [](double a, double b) { return b <= a * (1.0 + 1e-12); };
  edges.erase(std::ranges::unique(edges, same).begin(), edges.end());

  const Quadrature rule = three_between(edges);
  const Eigen::Index count = rule.frequency.size();
  const auto within = [&](double from, double to) {
    return (rule.frequency > two_pi * from && rule.frequency < two_pi * to)
        .select(rule.weight, 0.0)
        .eval();
  };
  RejectionResponse result;
  result.frequency = rule.frequency;
  result.wind_weight = within(band.lowest, band.highest);
  result.noise_weight = within(band.lowest, noise_end);
  result.boresight_by_wind_square.resize(count);
  for (auto& sensitivity : result.sensitivity) sensitivity.resize(count);
  std::array<Eigen::ArrayXd, 3> boresight, demand;
  for (std::size_t k = 0; k < boresight.size(); ++k) {
    boresight.at(k).resize(count);
    demand.at(k).resize(count);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto point = loop.at(rule.frequency[i]);
    result.boresight_by_wind_square[i] = std::norm(point.boresight_by_wind);
    for (std::size_t k = 0; k < boresight.size(); ++k) {
      result.sensitivity.at(k)[i] = 1.0 / std::abs(1.0 + point.loop_gain.at(k));
      boresight.at(k)[i] = std::norm(point.boresight_by_noise.at(k));
      demand.at(k)[i] = std::norm(point.demand_by_noise.at(k));
    }
  }
  if (sampled) {
    // What lies beyond the Nyquist frequency is an image of what is below it.
    for (auto& sensitivity : result.sensitivity) {
      sensitivity = (rule.frequency < two_pi * nyquist).select(sensitivity, std::nan("")).eval();
    }
  }
  const std::array rms{problem.noise.tachometer_rms, problem.noise.encoder_rms,
                       problem.noise.torque_rms};
  for (std::size_t k = 0; k < rms.size(); ++k) {
    const double bandwidth = problem.noise.bandwidth;
    result.noise_variance += variance(rms.at(k), bandwidth, boresight.at(k), result.noise_weight);
    result.effort_variance += variance(rms.at(k), bandwidth, demand.at(k), result.noise_weight);
  }
  return result;
}

double RejectionResponse::peak(std::size_t loop_break) const {
  const Eigen::ArrayXd& values = sensitivity.at(loop_break);
  double highest = std::numeric_limits<double>::quiet_NaN();
  Eigen::Index top = -1;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || values[i] <= highest) continue;
    highest = values[i];
    top = i;
  }
  if (top <= 0 || top + 1 >= values.size() || std::isnan(values[top + 1])) return highest;
  const double left = std::log(frequency[top - 1] / frequency[top]);
  const double right = std::log(frequency[top + 1] / frequency[top]);
  const double level = std::log(values[top]);
  const double from_left = (level - std::log(values[top - 1])) / -left;
  const double from_right = (std::log(values[top + 1]) - level) / right;
  const double curvature = (from_right - from_left) / (right - left);
  if (!(curvature < 0.0)) return highest;
  const double slope = from_right - curvature * right;
  const double at = std::clamp(-slope / (2.0 * curvature), left, right);
  return std::exp(level + at * (slope + curvature * at));
}

double rejection_lyapunov_rms(const TrackingProblem& problem, const plant::StateSpace& controller) {
  const auto wind = fit_wind_filter(problem);
  const auto antenna_form = demand_only(controller);
  if (antenna_form.sample_time > 0.0) {
    const control::SampledLoop loop{
        control::antenna_in_wind(problem.plant, wind),
        plant::renamed(antenna_form, {{"valve_demand", "valve_command"}}),
        antenna_form.sample_time};
    return control::sampled_pointing(loop, problem.noise).boresight_rms;
  }
  std::vector<plant::StateSpace> parts{plant::to_state_space(problem.plant),
                                       plant::to_state_space(wind, "wind_torque"),
                                       delayed(problem.delay)};
  std::vector<std::string> inputs{"white_noise"};
  std::map<std::string, std::string> with_noise;
  for (const auto& name : antenna_form.inputs) {
    with_noise[name] = name + "_measured";
    inputs.push_back(name + "_noise");
    parts.push_back(plant::static_gain(Eigen::MatrixXd::Ones(1, 2), {name, name + "_noise"},
                                       {name + "_measured"}));
  }
  parts.push_back(plant::renamed(antenna_form, with_noise));
  const auto loop = plant::connect(parts, inputs, {"beam"});
  Eigen::VectorXd intensity = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(inputs.size()));
  for (std::size_t i = 0; i < antenna_form.inputs.size(); ++i) {
    const double rms = antenna_form.inputs[i] == "tachometer" ? problem.noise.tachometer_rms
                       : antenna_form.inputs[i] == "encoder"  ? problem.noise.encoder_rms
                                                              : problem.noise.torque_rms;
    // A one-sided density over the bandwidth is an intensity of half that.
    intensity[static_cast<Eigen::Index>(i) + 1] = rms * rms / (2.0 * problem.noise.bandwidth);
  }
  const auto solution = control::solve_lyapunov(
      loop.a, loop.b * intensity.asDiagonal() * loop.b.transpose(), {.estimate_condition = false});
  return std::sqrt((loop.c * solution.covariance * loop.c.transpose())(0, 0));
}

}  // namespace boresight::design
