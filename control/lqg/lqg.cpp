#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/equations/riccati.hpp>
#include <boresight/control/lqg/lqg.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/plant/linear/covariance_propagation.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using Names = std::vector<std::string>;
using Weights = std::map<std::string, double>;

void check_names(const char* what, const Names& names, const Names& among) {
  for (const std::string& name : names) {
    if (std::ranges::find(among, name) == among.end()) {
      throw InvalidInput(fmt::format("lqg: expected each {} to be one of {}, found '{}'", what,
                                     fmt::join(among, ", "), name));
    }
  }
}

Names names_of(const Weights& weights) {
  Names names;
  for (const auto& [name, value] : weights) names.push_back(name);
  return names;
}

void check_weights(const char* what, const Weights& weights, const Names& among, bool positive) {
  check_names(what, names_of(weights), among);
  for (const auto& [name, value] : weights) {
    if (!(positive ? value > 0.0 : value >= 0.0) || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("lqg: expected each {} {} 0, found {} of '{}'", what,
                                     positive ? "above" : "of at least", value, name));
    }
  }
}

// A value for each name.
Eigen::VectorXd values_of(const char* what, const Weights& weights, const Names& names) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = weights.find(names[i]);
    if (found == weights.end()) {
      throw InvalidInput(
          fmt::format("lqg: expected each {} to be given, found none of '{}'", what, names[i]));
    }
    values[static_cast<Eigen::Index>(i)] = found->second;
  }
  return values;
}

void check(const LqgProblem& problem) {
  plant::validate(problem.plant);
  check_names("command", problem.commands, problem.plant.inputs);
  check_names("measured output", problem.measured, problem.plant.outputs);
  check_weights("disturbance intensity", problem.disturbance_intensity, problem.plant.inputs,
                false);
  check_weights("measurement variance", problem.measurement_variance, problem.measured, true);
  check_weights("output weight", problem.output_weight, problem.plant.outputs, false);
  check_weights("command weight", problem.command_weight, problem.commands, true);
  if (problem.commands.empty() || problem.measured.empty() || problem.output_weight.empty()) {
    throw InvalidInput(fmt::format(
        "lqg: expected at least one command, measured output and output weight, found "
        "{}, {} and {}",
        problem.commands.size(), problem.measured.size(), problem.output_weight.size()));
  }
}

// Of the continuous problem: noise into the states and cost of the outputs.
struct ContinuousParts {
  Eigen::MatrixXd commands;             // states x commands
  Eigen::MatrixXd intensity;            // states x states
  Eigen::MatrixXd output, feedthrough;  // weighted outputs, by the roots of their weights
};

ContinuousParts continuous_parts(const LqgProblem& problem) {
  const Names disturbances = names_of(problem.disturbance_intensity);
  const Names weighted = names_of(problem.output_weight);
  Names seen = weighted;
  for (const std::string& name : problem.measured) {
    if (std::ranges::find(seen, name) == seen.end()) seen.push_back(name);
  }
  const auto noise = plant::subsystem(problem.plant, disturbances, seen);
  const Eigen::MatrixXd drive =
      noise.b * values_of("disturbance intensity", problem.disturbance_intensity, disturbances)
                    .cwiseSqrt()
                    .asDiagonal();
  for (std::size_t j = 0; j < disturbances.size(); ++j) {
    if (problem.disturbance_intensity.at(disturbances[j]) == 0.0 ||
        noise.d.col(static_cast<Eigen::Index>(j)).isZero(0.0)) {
      continue;
    }
    throw InvalidInput(
        fmt::format("lqg: white noise of '{}' reaches a measured or weighted output without a lag, "
                    "so that its variance is infinite; put the filter that there is into the plant",
                    disturbances[j]));
  }
  const auto cost = plant::subsystem(problem.plant, problem.commands, weighted);
  const Eigen::VectorXd root =
      values_of("output weight", problem.output_weight, weighted).cwiseSqrt();
  return {cost.b, drive * drive.transpose(), root.asDiagonal() * cost.c,
          root.asDiagonal() * cost.d};
}

// The cost over one period as a quadratic form of [states; command that still acts; command to
// come], and the rows by which sampled states and new commands give these.
struct PeriodCost {
  Eigen::MatrixXd weight;
  Eigen::MatrixXd start;
};

PeriodCost period_cost(const LqgProblem& problem, const ContinuousParts& parts,
                       const plant::StateSpace& sampled, const plant::DeadTimeInSamples& late) {
  const Eigen::Index n = problem.plant.a.rows(), m = parts.commands.cols();
  const Eigen::Index all = n + 2 * m, states = sampled.a.rows();
  const auto of_part = [&](Eigen::Index acting) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(all, all);
    a.topLeftCorner(n, n) = problem.plant.a;
    a.block(0, acting, n, m) = parts.commands;
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(parts.output.rows(), all);
    c.leftCols(n) = parts.output;
    c.middleCols(acting, m) = parts.feedthrough;
    return std::pair(a, Eigen::MatrixXd(c.transpose() * c));
  };
  // The integral of exp(A't) W exp(A t) is the covariance that A' spreads from W.
  const auto integral = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& w, double time) {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(all, all);
    return Eigen::MatrixXd(time / problem.sample_time *
                           plant::propagate_covariance(a.transpose(), none, w, time).mean);
  };
  PeriodCost cost;
  const auto [a_after, w_after] = of_part(n + m);
  cost.weight = integral(a_after, w_after, problem.sample_time - late.rest);
  if (late.rest > 0.0) {
    const auto [a_before, w_before] = of_part(n);
    const Eigen::MatrixXd through = numerics::matrix_exponential(a_before * late.rest);
    cost.weight = (through.transpose() * cost.weight * through).eval() +
                  integral(a_before, w_before, late.rest);
  }
  cost.start = Eigen::MatrixXd::Zero(all, states + m);
  cost.start.topLeftCorner(n, n).setIdentity();
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto put = [&](Eigen::Index row, Eigen::Index ago) {
      if (ago == 0) {
        cost.start(row, states + j) = 1.0;
        return;
      }
      const std::string name =
          fmt::format("{}_held_{}", problem.commands[static_cast<std::size_t>(j)], ago);
      cost.start(row, std::ranges::find(sampled.states, name) - sampled.states.begin()) = 1.0;
    };
    if (late.rest > 0.0) put(n + j, late.samples + 1);
    put(n + m + j, late.samples);
  }
  return cost;
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

SampledLqgProblem sampled_problem(const LqgProblem& problem) {
  check(problem);
  const ContinuousParts parts = continuous_parts(problem);
  const Eigen::Index n = problem.plant.a.rows();
  SampledLqgProblem result;
  plant::SamplingOptions options;
  options.dead_times.assign(problem.commands.size(), problem.computation_delay);
  result.plant =
      plant::sample(plant::subsystem(problem.plant, problem.commands, problem.measured),
                    problem.sample_time, plant::SamplingMethod::zero_order_hold, options);
  if (!result.plant.d.isZero(0.0)) {
    throw InvalidInput(
        "lqg: a command reaches a measured output without delay; the sample would depend on the "
        "command that depends on it");
  }
  const Eigen::Index states = result.plant.a.rows();
  const auto m = static_cast<Eigen::Index>(problem.commands.size());
  result.process_covariance = Eigen::MatrixXd::Zero(states, states);
  const auto noise = plant::propagate_covariance(problem.plant.a, parts.intensity,
                                                 Eigen::MatrixXd::Zero(n, n), problem.sample_time);
  result.process_covariance.topLeftCorner(n, n) = noise.end;
  result.unavoidable_cost = (parts.output * noise.mean * parts.output.transpose()).trace();
  result.measurement_covariance =
      values_of("measurement variance", problem.measurement_variance, problem.measured)
          .asDiagonal();
  const PeriodCost cost =
      period_cost(problem, parts, result.plant,
                  plant::dead_time_in_samples(problem.computation_delay, problem.sample_time));
  const Eigen::MatrixXd weight = symmetric(cost.start.transpose() * cost.weight * cost.start);
  result.q = weight.topLeftCorner(states, states);
  result.s = weight.topRightCorner(states, m);
  result.r = weight.bottomRightCorner(m, m);
  result.r.diagonal() += values_of("command weight", problem.command_weight, problem.commands);
  return result;
}

LqRegulator lq_regulator(const SampledLqgProblem& problem) {
  const auto solution =
      solve_discrete_riccati({problem.plant.a, problem.plant.b, problem.q, problem.r, problem.s},
                             {.estimate_condition = false});
  return {solution.gain, solution.x,
          problem.r + symmetric(problem.plant.b.transpose() * solution.x * problem.plant.b),
          solution.eigenvalues, solution.relative_residual};
}

StateEstimator state_estimator(const SampledLqgProblem& problem) {
  const Eigen::MatrixXd& c = problem.plant.c;
  const auto solution = solve_discrete_riccati({problem.plant.a.transpose(),
                                                c.transpose(),
                                                problem.process_covariance,
                                                problem.measurement_covariance,
                                                {}},
                                               {.estimate_condition = false});
  const Eigen::MatrixXd innovation =
      symmetric(c * solution.x * c.transpose()) + problem.measurement_covariance;
  const Eigen::MatrixXd gain =
      numerics::positive_definite_solve(innovation, c * solution.x, "innovation covariance")
          .transpose();
  // Joseph's form: a sum of positive terms.
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(c.cols(), c.cols()) - gain * c;
  return {gain, solution.x,
          symmetric(rest * solution.x * rest.transpose() +
                    gain * problem.measurement_covariance * gain.transpose()),
          solution.eigenvalues, solution.relative_residual};
}

plant::StateSpace lqg_controller(const SampledLqgProblem& problem, const LqRegulator& regulator,
                                 const StateEstimator& estimator) {
  const plant::StateSpace& plant = problem.plant;
  const Eigen::Index n = plant.a.rows();
  const Eigen::MatrixXd closed = plant.a - plant.b * regulator.gain;
  const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(n, n) - estimator.gain * plant.c;
  plant::StateSpace controller{closed * kept,
                               closed * estimator.gain,
                               -regulator.gain * kept,
                               -regulator.gain * estimator.gain,
                               plant.outputs,
                               plant.inputs,
                               {},
                               plant.sample_time};
  for (const std::string& state : plant.states) controller.states.push_back(state + "_estimated");
  return controller;
}

LqgDesign lqg(const LqgProblem& problem) {
  const SampledLqgProblem sampled = sampled_problem(problem);
  LqgDesign design;
  design.regulator = lq_regulator(sampled);
  design.estimator = state_estimator(sampled);
  design.controller = lqg_controller(sampled, design.regulator, design.estimator);
  design.full_information_cost =
      sampled.unavoidable_cost +
      design.regulator.cost_to_go.cwiseProduct(sampled.process_covariance).sum();
  const Eigen::MatrixXd& k = design.regulator.gain;
  design.cost =
      design.full_information_cost +
      (design.regulator.input_cost * k * design.estimator.estimate_covariance * k.transpose())
          .trace();
  return design;
}

}  // namespace boresight::control
