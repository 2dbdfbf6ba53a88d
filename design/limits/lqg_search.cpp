#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Peaks are read off a parabola between frequencies: what it can miss is kept in hand.
constexpr double reserve = 1e-3;
// Of the logarithm of the command weight: finer changes the rms by less than 1e-3.
constexpr double weight_tolerance = 0.01;
constexpr double weight_step = 0.8;
constexpr int max_command_weights = 30;
constexpr int most_compass_points = 40;

// The plant with an input and an output for each spring: an error of the deflection that it feels,
// the deflection.
struct SpringPorts {
  plant::StateSpace plant;
  std::vector<std::string> errors, deflections;
  std::string friction;  // a torque at the motor
};

SpringPorts with_spring_ports(const SampledSetting& setting) {
  const plant::Structure& structure = setting.plant().structure;
  const plant::Drive& drive = setting.plant().drive;
  SpringPorts result{setting.problem().plant, {}, {}, "friction_torque"};
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
  const Eigen::Index inputs = system.b.cols();
  system.b.conservativeResize(Eigen::NoChange, inputs + 1);
  system.b.col(inputs).setZero();
  system.b(state("motor_rate"), inputs) = 1.0 / drive.motor_inertia;
  system.d.conservativeResizeLike(Eigen::MatrixXd::Zero(system.c.rows(), inputs + 1));
  system.inputs.push_back(result.friction);
  return result;
}

// What weights of one add to the sampled problem.
struct UnitTerms {
  Eigen::MatrixXd input_noise, spring_noise, friction_noise;  // process covariance
  Eigen::MatrixXd spring_cost_q, spring_cost_s, spring_cost_r;
};

UnitTerms unit_terms(const SampledSetting& setting) {
  const SpringPorts springs = with_spring_ports(setting);
  control::LqgProblem problem = setting.problem();
  std::vector<std::string> outputs{"tachometer", "motor_torque", "encoder"};
  outputs.insert(outputs.end(), springs.deflections.begin(), springs.deflections.end());
  problem.plant = plant::subsystem(springs.plant, springs.plant.inputs, outputs);
  problem.disturbance_intensity = {{"valve_command", 1.0}};
  problem.output_weight.clear();
  for (const std::string& deflection : springs.deflections) problem.output_weight[deflection] = 1.0;
  const control::SampledLqgProblem of_input = control::sampled_problem(problem);
  problem.disturbance_intensity = {{springs.friction, 1.0}};
  const Eigen::MatrixXd of_friction = control::sampled_problem(problem).process_covariance;
  problem.disturbance_intensity.clear();
  for (const std::string& error : springs.errors) problem.disturbance_intensity[error] = 1.0;
  return {of_input.process_covariance,
          control::sampled_problem(problem).process_covariance,
          of_friction,
          of_input.q,
          of_input.s,
          of_input.r};
}

// The problem that the design believes in.
control::SampledLqgProblem believed(const SampledSetting& setting, const UnitTerms& terms,
                                    const LqgWeights& weights) {
  control::SampledLqgProblem problem = setting.sampled();
  problem.process_covariance += weights.input_noise * terms.input_noise +
                                weights.spring_noise * terms.spring_noise +
                                weights.friction_noise * terms.friction_noise;
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
  // The LQG of `model`, evaluated on `plants`.
  Search(const SampledSetting& model, const std::vector<SampledSetting>& plants,
         const LqgSearchGoals& goals, unsigned threads)
      : model_(model),
        plants_(plants),
        goals_(goals),
        threads_(threads),
        terms_(unit_terms(model)) {
    // Both terms of the cost are of one size six steps above when the effort is what is allowed.
    const double slack = model.evaluate(weighted_lqg(model, {.command_weight = 1.0})).boresight_rms;
    first_weight_ = 2.0 * std::log(slack / goals.control_effort) - 6.0;
    spring_unit_ = slack * slack * model.problem().sample_time;
    result_.boresight_rms = infinity;
  }

  // White noise of the effort that is allowed.
  double input_unit() const {
    return goals_.control_effort * goals_.control_effort * model_.problem().sample_time;
  }
  double spring_unit() const { return spring_unit_; }
  // The same deflection on the oil spring, as torque.
  double friction_unit() const {
    const double stiffness = model_.plant().drive.oil_stiffness;
    return stiffness * stiffness * spring_unit_;
  }

  // The least rms with these weights and the least command weight that keeps the goals; infinite
  // if none does. Keeps the record.
  double rms_at(LqgWeights weights) {
    Trial kept = min_weight(weights);
    if (kept.excess > 0.0) return infinity;
    // One plant's goals have no gaps worth the time: the next search begins about here.
    if (plants_.size() == 1) first_weight_ = kept.log_weight - weight_step;
    const double rms = largest_rms(kept.controller);
    if (rms < result_.boresight_rms) {
      weights.command_weight = std::exp(kept.log_weight);
      result_.found = true;
      result_.weights = weights;
      result_.controller = std::move(kept.controller);
      result_.boresight_rms = rms;
    }
    return rms;
  }

  const LqgSearchResult& result() const { return result_; }

 private:
  Trial min_weight(const LqgWeights& weights) {
    control::SampledLqgProblem problem = believed(model_, terms_, weights);
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
      trial.excess = excess(trial.controller);
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

  double excess(const plant::StateSpace& controller) const {
    constexpr double unstable = 3.0;
    const Eigen::ArrayXXcd response =
        SampledSetting::controller_response(controller, model_.frequency());
    double peak = 0.0;
    for (const SampledSetting& one : plants_) {
      peak = std::max(peak, one.highest_peak(response).magnitude);
    }
    const double of_peak = std::log(peak / goals_.sensitivity_peak) + reserve;
    if (of_peak > 0.0) return std::min(of_peak, unstable);
    std::vector<double> effort(plants_.size());
    numerics::for_each_index(plants_.size(), threads_, [&](std::size_t i) {
      const bool stable = plants_[i].spectral_radius(controller) < 1.0;
      effort[i] = stable ? plants_[i].control_effort(controller) : infinity;
    });
    const double largest = *std::ranges::max_element(effort);
    return std::min(std::max(of_peak, std::log(largest / goals_.control_effort) + 1e-6), unstable);
  }

  // Of a controller that is stable on all.
  double largest_rms(const plant::StateSpace& controller) const {
    std::vector<double> rms(plants_.size());
    numerics::for_each_index(rms.size(), threads_,
                             [&](std::size_t i) { rms[i] = plants_[i].boresight_rms(controller); });
    return *std::ranges::max_element(rms);
  }

  const SampledSetting& model_;
  const std::vector<SampledSetting>& plants_;
  LqgSearchGoals goals_;
  unsigned threads_;
  UnitTerms terms_;
  double first_weight_ = 0.0;
  double spring_unit_ = 0.0;
  LqgSearchResult result_;
};

void check(const LqgSearchGoals& goals) {
  if (!(goals.sensitivity_peak > 1.0) || !(goals.control_effort > 0.0)) {
    throw InvalidInput(
        fmt::format("LQG search: expected a sensitivity_peak above 1 and a valve_effort above 0, "
                    "found {} and {} rad/s",
                    goals.sensitivity_peak, goals.control_effort));
  }
}

}  // namespace

plant::StateSpace weighted_lqg(const SampledSetting& setting, const LqgWeights& weights) {
  const control::SampledLqgProblem problem = believed(setting, unit_terms(setting), weights);
  return control::lqg_controller(problem, control::lq_regulator(problem),
                                 control::state_estimator(problem));
}

LqgSearchResult search_limited_lqg(const SampledSetting& nominal, const LqgSearchGoals& goals) {
  check(goals);
  const std::vector<SampledSetting> itself{nominal};
  Search search(nominal, itself, goals, 1);
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
                                  const std::vector<SampledSetting>& plants,
                                  const LqgSearchGoals& goals, unsigned threads) {
  check(goals);
  if (plants.empty()) throw InvalidInput("LQG search: expected at least one plant, found none");
  for (const SampledSetting& one : plants) {
    if (one.frequency().size() != model.frequency().size() ||
        (one.frequency() != model.frequency()).any()) {
      throw InvalidInput("LQG search: expected the same frequencies in every setting");
    }
  }
  Search search(model, plants, goals, threads);
  const auto rms_at = [&](const std::array<double, 4>& place) {
    return search.rms_at({.input_noise = search.input_unit() * std::exp(place[0]),
                          .spring_noise = search.spring_unit() * std::exp(place[1]),
                          .spring_weight = std::exp(place[2]),
                          .friction_noise = search.friction_unit() * std::exp(place[3])});
  };
  const double decade = std::numbers::ln10;
  std::array<double, 4> place{1.5 * decade, -1.5 * decade, 0.0, 0.0};
  double best = rms_at(place);
  int points = 1;
  for (double step = decade; step > 0.5 && points < most_compass_points; step *= 0.5) {
    for (bool moved = true; moved && points < most_compass_points;) {
      moved = false;
      for (std::size_t k = 0; k < place.size(); ++k) {
        for (const double direction : {1.0, -1.0}) {
          std::array<double, 4> next = place;
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
  return search.result();
}

}  // namespace boresight::design
