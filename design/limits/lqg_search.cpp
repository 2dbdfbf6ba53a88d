#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <boresight/design/limits/controller_reduction.hpp>
#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Of the logarithm of the command weight: finer changes the rms by less than 1e-3.
constexpr double weight_tolerance = 0.01;
constexpr double weight_step = 0.8;
constexpr int max_command_weights = 30;
constexpr int most_compass_points = 60;
// What a controller of lower order may cost: its rms over that of the full order.
constexpr double reduced_rms = 1.01;

// The plant with what designs add: for each spring an error of the deflection that it feels and the
// deflection; friction as a torque that changes slowly.
struct DesignPorts {
  plant::StateSpace plant;
  std::vector<std::string> errors, deflections;
  std::string friction;  // white noise that makes the torque's variance 1; the torque's state
};

DesignPorts with_design_ports(const SampledSetting& setting, double friction_corner) {
  const plant::Structure& structure = setting.plant().structure;
  const plant::Drive& drive = setting.plant().drive;
  DesignPorts result{setting.problem().plant, {}, {}, "friction_torque"};
  plant::StateSpace& system = result.plant;
  const auto state = [&](const std::string& name) {
    return static_cast<Eigen::Index>(std::ranges::find(system.states, name) -
                                     system.states.begin());
  };
  const auto add = [&](const std::string& near, const std::string& far, double torque_near,
                       double torque_far) {
    const Eigen::Index inputs = system.b.cols(), outputs = system.c.rows();
    system.b.conservativeResize(Eigen::NoChange, inputs + 1);
    system.c.conservativeResize(outputs + 1, Eigen::NoChange);
    system.b.col(inputs).setZero();
    system.c.row(outputs).setZero();
    system.d.conservativeResizeLike(Eigen::MatrixXd::Zero(outputs + 1, inputs + 1));
    system.b(state(near + "_rate"), inputs) = torque_near;
    system.b(state(far + "_rate"), inputs) = torque_far;
    system.c(outputs, state(near + "_angle")) = 1.0;
    system.c(outputs, state(far + "_angle")) = -1.0;
    result.errors.push_back(far + "_spring_error");
    result.deflections.push_back(far + "_deflection");
    system.inputs.push_back(result.errors.back());
    system.outputs.push_back(result.deflections.back());
  };
  add("motor", "bull_gear", -structure.gear_stiffness / drive.motor_inertia,
      structure.gear_stiffness / structure.bull_gear_inertia);
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    const plant::StructuralMode& mode = structure.modes[i];
    add("bull_gear", fmt::format("mode_{}", i + 1), -mode.stiffness / structure.bull_gear_inertia,
        mode.stiffness / mode.inertia);
  }
  const Eigen::Index states = system.a.rows(), inputs = system.b.cols();
  system.a.conservativeResizeLike(Eigen::MatrixXd::Zero(states + 1, states + 1));
  system.a(states, states) = -friction_corner;
  system.a(state("motor_rate"), states) = 1.0 / drive.motor_inertia;
  system.b.conservativeResizeLike(Eigen::MatrixXd::Zero(states + 1, inputs + 1));
  system.b(states, inputs) = std::sqrt(2.0 * friction_corner);
  system.c.conservativeResizeLike(Eigen::MatrixXd::Zero(system.c.rows(), states + 1));
  system.d.conservativeResizeLike(Eigen::MatrixXd::Zero(system.c.rows(), inputs + 1));
  system.states.push_back(result.friction);
  system.inputs.push_back(result.friction);
  return result;
}

// What weights of one add to the sampled problem.
struct UnitTerms {
  double friction_corner = 0.0;
  control::SampledLqgProblem base;                      // without the terms
  Eigen::MatrixXd input_noise, spring_noise, friction;  // process covariance
  Eigen::MatrixXd spring_cost_q, spring_cost_s, spring_cost_r;
};

UnitTerms unit_terms(const SampledSetting& setting, double friction_corner) {
  const DesignPorts ports = with_design_ports(setting, friction_corner);
  control::LqgProblem problem = setting.problem();
  std::vector<std::string> outputs{"tachometer", "motor_torque", "encoder"};
  outputs.insert(outputs.end(), ports.deflections.begin(), ports.deflections.end());
  problem.plant = ports.plant;
  control::SampledLqgProblem base = control::sampled_problem(problem);
  problem.plant = plant::subsystem(ports.plant, ports.plant.inputs, outputs);
  problem.disturbance_intensity = {{"valve_command", 1.0}};
  problem.output_weight.clear();
  for (const std::string& deflection : ports.deflections) problem.output_weight[deflection] = 1.0;
  const control::SampledLqgProblem of_input = control::sampled_problem(problem);
  problem.disturbance_intensity = {{ports.friction, 1.0}};
  const Eigen::MatrixXd of_friction = control::sampled_problem(problem).process_covariance;
  problem.disturbance_intensity.clear();
  for (const std::string& error : ports.errors) problem.disturbance_intensity[error] = 1.0;
  return {friction_corner,
          std::move(base),
          of_input.process_covariance,
          control::sampled_problem(problem).process_covariance,
          of_friction,
          of_input.q,
          of_input.s,
          of_input.r};
}

// The problem that the design believes in.
control::SampledLqgProblem believed(const UnitTerms& terms, const LqgWeights& weights) {
  control::SampledLqgProblem problem = terms.base;
  problem.process_covariance += weights.input_noise * terms.input_noise +
                                weights.spring_noise * terms.spring_noise +
                                weights.friction_torque * weights.friction_torque * terms.friction;
  problem.q += weights.spring_weight * terms.spring_cost_q;
  problem.s += weights.spring_weight * terms.spring_cost_s;
  problem.r += weights.spring_weight * terms.spring_cost_r;
  problem.r.diagonal().array() += weights.command_weight;
  return problem;
}

// A command weight tried with the other weights given.
struct Trial {
  double log_weight = 0.0;
  /// ln of the largest ratio of a quantity to its goal: met up to 0.
  double excess = infinity;
  plant::StateSpace controller;
};

class Search {
 public:
  // The LQG of `model`, evaluated under the constraints.
  Search(const SampledSetting& model, const RobustConstraints& constraints)
      : model_(model), constraints_(constraints) {
    // Both terms of the cost are of one size six steps above when the effort is what is allowed.
    const double slack = model.evaluate(weighted_lqg(model, {.command_weight = 1.0})).boresight_rms;
    first_weight_ = 2.0 * std::log(slack / constraints.goals().control_effort) - 6.0;
    spring_unit_ = slack * slack * model.problem().sample_time;
    result_.boresight_rms = infinity;
  }

  // White noise of the effort that is allowed.
  double input_unit() const {
    const double effort = constraints_.goals().control_effort;
    return effort * effort * model_.problem().sample_time;
  }
  double spring_unit() const { return spring_unit_; }
  // The same deflection on the oil spring, as torque.
  double friction_unit() const {
    return model_.plant().drive.oil_stiffness *
           std::sqrt(spring_unit_ / model_.problem().sample_time);
  }

  // The least rms with these weights and the least command weight that keeps the goals; infinite
  // if none does. Keeps the record.
  double rms_at(LqgWeights weights) {
    Trial kept = min_weight(weights);
    if (kept.excess > 0.0) return infinity;
    // One plant's goals have no gaps worth the time: the next search begins about here.
    if (constraints_.plants().size() == 1) first_weight_ = kept.log_weight - weight_step;
    const double rms = constraints_.largest_rms(kept.controller);
    if (rms < result_.boresight_rms) {
      weights.command_weight = std::exp(kept.log_weight);
      result_.found = true;
      result_.weights = weights;
      result_.full_order = kept.controller.a.rows();
      result_.controller = std::move(kept.controller);
      result_.boresight_rms = rms;
    }
    return rms;
  }

  const LqgSearchResult& result() const { return result_; }

  // The result with the controller of the lowest order that meets the constraints with an rms at
  // most reduced_rms times as large.
  LqgSearchResult reduced() const {
    LqgSearchResult found = result_;
    if (!found.found) return found;
    const ControllerReduction reduction(
        found.controller,
        model_.controller_gramians(found.controller, found.weights.command_weight));
    for (Eigen::Index order = 1; order < reduction.largest_order(); ++order) {
      plant::StateSpace candidate = reduction.of_order(order);
      ++found.candidates;
      if (constraints_.excess(candidate) > 0.0) continue;
      const double rms = constraints_.largest_rms(candidate);
      if (rms > reduced_rms * result_.boresight_rms) continue;
      found.controller = std::move(candidate);
      found.boresight_rms = rms;
      break;
    }
    return found;
  }

 private:
  Trial min_weight(const LqgWeights& weights) {
    if (!terms_ || terms_->friction_corner != weights.friction_corner) {
      terms_ = unit_terms(model_, weights.friction_corner);
    }
    control::SampledLqgProblem problem = believed(*terms_, weights);
    const double own = problem.r(0, 0);
    const control::StateEstimator estimator = control::state_estimator(problem);
    Trial below, above;  // the weight too small, the weight that does
    below.log_weight = -infinity;
    above.log_weight = infinity;
    // Upwards from below: goals may be kept again at much larger weights with a gap between.
    double next = first_weight_;
    for (int i = 0;
         i < max_command_weights && above.log_weight - below.log_weight > weight_tolerance; ++i) {
      Trial trial;
      trial.log_weight = next;
      problem.r(0, 0) = own + std::exp(next);
      trial.controller =
          control::lqg_controller(problem, control::lq_regulator(problem), estimator);
      trial.excess = constraints_.excess(trial.controller);
      ++result_.candidates;
      (trial.excess <= 0.0 ? above : below) = std::move(trial);
      if (std::isinf(below.log_weight)) {
        next = above.log_weight - weight_step;
      } else if (std::isinf(above.log_weight)) {
        next = below.log_weight + weight_step;
      } else {
        // Towards the zero of the excess, off the ends so that the bracket shrinks from both.
        const double fraction = below.excess / (below.excess - above.excess);
        next = below.log_weight +
               std::clamp(fraction, 0.15, 0.85) * (above.log_weight - below.log_weight);
      }
    }
    return above;
  }

  const SampledSetting& model_;
  const RobustConstraints& constraints_;
  std::optional<UnitTerms> terms_;
  double first_weight_ = 0.0;
  double spring_unit_ = 0.0;
  LqgSearchResult result_;
};

}  // namespace

plant::StateSpace weighted_lqg(const SampledSetting& setting, const LqgWeights& weights) {
  const control::SampledLqgProblem problem =
      believed(unit_terms(setting, weights.friction_corner), weights);
  return control::lqg_controller(problem, control::lq_regulator(problem),
                                 control::state_estimator(problem));
}

LqgSearchResult search_limited_lqg(const SampledSetting& nominal, const SampledLoopGoals& goals) {
  const RobustConstraints constraints({.plants = {&nominal, 1}}, goals, 1);
  Search search(nominal, constraints);
  const auto rms_at = [&](double log_noise) {
    return search.rms_at({.input_noise = search.input_unit() * std::exp(log_noise)});
  };
  constexpr int decades = 8;
  const double step = std::numbers::ln10, first = -3.0 * step;
  int best = 0;
  std::array<double, decades + 1> scan{};
  for (int i = 0; i <= decades; ++i) {
    scan.at(static_cast<std::size_t>(i)) = rms_at(first + i * step);
    if (scan.at(static_cast<std::size_t>(i)) < scan.at(static_cast<std::size_t>(best))) best = i;
  }
  if (search.result().found) {
    // Over the two decades about the best; the record keeps the least.
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = first + (best - 1) * step, high = low + 2.0 * step;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = rms_at(left), at_right = rms_at(right);
    for (int i = 0; i < 3; ++i) {
      if (at_left <= at_right) {
        high = right, right = left, at_right = at_left;
        left = high - golden * (high - low);
        at_left = rms_at(left);
      } else {
        low = left, left = right, at_left = at_right;
        right = low + golden * (high - low);
        at_right = rms_at(right);
      }
    }
  }
  return search.result();
}

LqgSearchResult search_robust_lqg(const SampledSetting& model,
                                  const RobustConstraints& constraints) {
  Search search(model, constraints);
  const auto rms_at = [&](const std::array<double, 5>& place) {
    return search.rms_at({.input_noise = search.input_unit() * std::exp(place[0]),
                          .spring_noise = search.spring_unit() * std::exp(place[1]),
                          .spring_weight = std::exp(place[2]),
                          .friction_torque = search.friction_unit() * std::exp(0.5 * place[3]),
                          .friction_corner = std::exp(place[4])});
  };
  const double decade = std::numbers::ln10;
  std::array<double, 5> place{1.5 * decade, -1.5 * decade, 0.0, decade, -0.5 * decade};

  double best = rms_at(place);
  int points = 1;
  for (double step = decade; step > 0.5 && points < most_compass_points; step *= 0.5) {
    for (bool moved = true; moved && points < most_compass_points;) {
      moved = false;
      for (std::size_t k = 0; k < place.size(); ++k) {
        for (const double direction : {1.0, -1.0}) {
          std::array<double, 5> next = place;
          next.at(k) += direction * step;
          const double rms = rms_at(next);
          ++points;
          if (!(rms < best)) continue;
          best = rms;
          place = next;
          moved = true;
          break;
        }
      }
    }
  }
  return search.reduced();
}

}  // namespace boresight::design
