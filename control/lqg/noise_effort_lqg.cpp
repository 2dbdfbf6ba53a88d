#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/equations/riccati.hpp>
#include <boresight/control/lqg/noise_effort_lqg.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

// States of the sampled plant that its commands reach, by the zeros of the continuous A: shaping
// filters are not among them.
std::vector<Eigen::Index> reached_states(const LqgProblem& problem, Eigen::Index all) {
  const plant::StateSpace driven =
      plant::subsystem(problem.plant, problem.commands, problem.measured);
  const Eigen::Index n = driven.a.rows();
  std::vector<bool> reached(static_cast<std::size_t>(all), true);
  for (Eigen::Index i = 0; i < n; ++i) {
    reached[static_cast<std::size_t>(i)] = !driven.b.row(i).isZero(0.0);
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (reached[static_cast<std::size_t>(i)]) continue;
      for (Eigen::Index j = 0; j < n; ++j) {
        if (driven.a(i, j) == 0.0 || !reached[static_cast<std::size_t>(j)]) continue;
        reached[static_cast<std::size_t>(i)] = grown = true;
        break;
      }
    }
  }
  std::vector<Eigen::Index> states;
  for (Eigen::Index i = 0; i < all; ++i) {
    if (reached[static_cast<std::size_t>(i)]) states.push_back(i);
  }
  return states;
}

// z[k+1] = A z + B v: sensor noise v through W, one copy a sensor, and the estimator's error that
// it drives; `innovation` and `error` (-> K e) are read from z and v.
struct NoiseModel {
  Eigen::MatrixXd a, b;
  Eigen::MatrixXd innovation, innovation_direct;
  Eigen::MatrixXd error, error_direct;
};

NoiseModel noise_model(const SampledLqgProblem& sampled, const LqgDesign& design,
                       const std::vector<Eigen::Index>& reached) {
  const plant::StateSpace& plant = sampled.plant;
  const Eigen::MatrixXd& k = design.regulator.gain;
  const Eigen::MatrixXd& m = design.estimator.gain;
  const Eigen::Index n = plant.a.rows(), sensors = plant.c.rows();
  const auto copy = static_cast<Eigen::Index>(reached.size());
  const Eigen::Index copies = sensors * copy, size = copies + n;
  const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(n, n) - m * plant.c;
  const Eigen::MatrixXd closed = plant.a(reached, reached) - plant.b(reached, 0) * k(0, reached);
  NoiseModel model;
  model.a = Eigen::MatrixXd::Zero(size, size);
  model.b = Eigen::MatrixXd::Zero(size, sensors);
  Eigen::MatrixXd shaped = Eigen::MatrixXd::Zero(sensors, size);  // W v less v itself
  for (Eigen::Index i = 0; i < sensors; ++i) {
    model.a.block(i * copy, i * copy, copy, copy) = closed;
    model.b.block(i * copy, i, copy, 1) = plant.b(reached, 0);
    shaped.block(i, i * copy, 1, copy) = -k(0, reached);
  }
  const Eigen::MatrixXd correction = plant.a * m;
  model.a.bottomRows(n) = -correction * shaped;
  model.a.bottomRightCorner(n, n) += plant.a * kept;
  model.b.bottomRows(n) = -correction;
  model.innovation = shaped;
  model.innovation.rightCols(n) += plant.c;
  model.innovation_direct = Eigen::MatrixXd::Identity(sensors, sensors);
  model.error = -(k * m) * shaped;
  model.error.rightCols(n) += k * kept;
  model.error_direct = -(k * m);
  return model;
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

// The LQG with u = -K (estimate) - H(z) (innovation), H the filter with predictor gain L, direct
// gain D and read-out C.
plant::StateSpace extended_controller(const SampledLqgProblem& sampled, const LqgDesign& design,
                                      const NoiseModel& model, const Eigen::MatrixXd& predictor,
                                      const Eigen::MatrixXd& direct) {
  const plant::StateSpace& plant = sampled.plant;
  const Eigen::MatrixXd& k = design.regulator.gain;
  const Eigen::MatrixXd& m = design.estimator.gain;
  const Eigen::Index n = plant.a.rows(), extra = model.a.rows(), sensors = plant.c.rows();
  const Eigen::MatrixXd of_innovation = k * m + direct;
  plant::StateSpace controller;
  controller.d = -of_innovation;
  controller.c = Eigen::MatrixXd::Zero(1, n + extra);
  controller.c.leftCols(n) = -k + of_innovation * plant.c;
  controller.c.rightCols(extra) = -(model.error - direct * model.innovation);
  controller.a = Eigen::MatrixXd::Zero(n + extra, n + extra);
  controller.b = Eigen::MatrixXd::Zero(n + extra, sensors);
  controller.a.topRows(n) = plant.b * controller.c;
  controller.a.topLeftCorner(n, n) += plant.a * (Eigen::MatrixXd::Identity(n, n) - m * plant.c);
  controller.b.topRows(n) = plant.a * m + plant.b * controller.d;
  controller.a.bottomLeftCorner(extra, n) = -predictor * plant.c;
  controller.a.bottomRightCorner(extra, extra) = model.a - predictor * model.innovation;
  controller.b.bottomRows(extra) = predictor;
  controller.inputs = plant.outputs;
  controller.outputs = plant.inputs;
  controller.states = design.controller.states;
  for (Eigen::Index i = 0; i < extra; ++i) {
    controller.states.push_back(fmt::format("innovation_filter_{}", i + 1));
  }
  controller.sample_time = plant.sample_time;
  return controller;
}

}  // namespace

NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, double noise_effort_weight) {
  return noise_effort_lqg(problem, sampled_problem(problem), lqg(problem), noise_effort_weight);
}

NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, const SampledLqgProblem& sampled,
                                   const LqgDesign& design, double noise_effort_weight) {
  if (problem.commands.size() != 1) {
    throw InvalidInput(
        fmt::format("noise_effort_lqg: expected one command, found {}", problem.commands.size()));
  }
  if (!(noise_effort_weight > 0.0) || !std::isfinite(noise_effort_weight)) {
    throw InvalidInput(fmt::format(
        "noise_effort_lqg: expected a noise_effort_weight above 0, found {}", noise_effort_weight));
  }
  const plant::StateSpace& plant = sampled.plant;
  const NoiseModel model = noise_model(sampled, design, reached_states(problem, plant.a.rows()));
  const Eigen::MatrixXd& v = sampled.measurement_covariance;
  const Eigen::MatrixXd innovation =
      symmetric(plant.c * design.estimator.prediction_covariance * plant.c.transpose()) + v;
  // Everything divided by the weight: the filter's own noise is then what Q costs otherwise.
  const Eigen::MatrixXd cost_of_q =
      design.regulator.input_cost(0, 0) / noise_effort_weight * innovation;
  // The noise of the states that the filter's own noise does not tell, (V^-1 + (own)^-1)^-1,
  // without differences: the equation then has no cross term.
  const Eigen::MatrixXd read = symmetric(v + cost_of_q);
  const Eigen::MatrixXd untold =
      v * numerics::positive_definite_solve(read, cost_of_q, "noise_effort_lqg");
  const Eigen::MatrixXd told =
      model.b * numerics::positive_definite_solve(read, v, "noise_effort_lqg").transpose();
  const auto filter =
      solve_discrete_riccati({(model.a - told * model.innovation).transpose(),
                              model.innovation.transpose(),
                              symmetric(model.b * symmetric(untold) * model.b.transpose()),
                              read,
                              {}},
                             {.estimate_condition = false});
  const Eigen::MatrixXd seen =
      symmetric(model.innovation * filter.x * model.innovation.transpose()) + read;
  const Eigen::MatrixXd common =
      model.error * filter.x * model.innovation.transpose() + model.error_direct * v;
  const Eigen::MatrixXd direct =
      numerics::positive_definite_solve(seen, common.transpose(), "noise_effort_lqg").transpose();
  const double wanted = (model.error * filter.x * model.error.transpose() +
                         model.error_direct * v * model.error_direct.transpose())(0, 0);
  const double minimum = wanted - (direct * common.transpose())(0, 0);
  return {extended_controller(sampled, design, model, filter.gain.transpose() + told, direct),
          design.cost + noise_effort_weight * minimum};
}

}  // namespace boresight::control
