#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/control/loops/state_space_controller_response.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index points = 16;       // of a period
constexpr Index supports = 32;     // of the matrix exponential within it
constexpr double resolved = 15.0;  // largest |pole| x period that these follow
constexpr double max_parts = 8.0;
constexpr double max_work = 4e9;        // multiplications of one course
constexpr double without_delay = 0.02;  // s, period of a loop that sets none

struct Rule {
  VectorXd fraction, weight, barycentric;
};

// Gauss's rule on (0, 1).
Rule gauss_rule(Index count) {
  const numerics::GaussRule rule = numerics::gauss_rule(static_cast<int>(count));
  const auto column = [&](const std::vector<double>& values) {
    return Eigen::Map<const VectorXd>(values.data(), count);
  };
  return {0.5 * (1.0 + column(rule.node).array()), 0.5 * column(rule.weight),
          column(rule.barycentric)};
}

// Values at `at` of the polynomials that are 1 at one point of a rule and 0 at the others.
VectorXd cardinals(const VectorXd& fraction, const VectorXd& barycentric, double at) {
  VectorXd result(fraction.size());
  for (Index j = 0; j < fraction.size(); ++j) {
    const double distance = at - fraction[j];
    if (distance == 0.0) return VectorXd::Unit(fraction.size(), j);
    result[j] = barycentric[j] / distance;
  }
  return result / result.sum();
}

// Plant and controller, the valve's command from outside; inputs valve_command, wind_torque;
// outputs valve_demand, beam.
plant::StateSpace open_loop(const plant::AntennaPlant& antenna,
                            const plant::StateSpace& controller) {
  std::vector<std::string> inputs = controller.inputs;
  std::erase(inputs, "rate_disturbance");
  return plant::connect(
      {plant::to_state_space(antenna), plant::subsystem(controller, inputs, {"valve_demand"})},
      {"valve_command", "wind_torque"}, {"valve_demand", "beam"});
}

// Where the period ends in parts short enough for the poles.
double parts_of(const MatrixXd& a, double time) {
  const double fastest = numerics::spectral_radius(a);
  const double parts = std::max(1.0, std::ceil(fastest * time / resolved));
  if (!(parts <= max_parts)) {
    throw NumericalFailure(
        fmt::format("controlled course: a pole of {:.3g} rad/s is too fast to be followed through "
                    "{:g} s: reduce the controller's order, poles that fast do nothing",
                    fastest, time));
  }
  return parts;
}

}  // namespace

ClosedLoopResponse::ClosedLoopResponse(const plant::AntennaPlant& antenna,
                                       const plant::StateSpace& controller, double delay) {
  if (!(delay >= 0.0) || !std::isfinite(delay)) {
    throw InvalidInput(
        fmt::format("ClosedLoopResponse: expected a delay of 0 or more, found {} s", delay));
  }
  const plant::StateSpace antenna_form = antenna_state_space_controller(controller);
  const bool sampled = antenna_form.sample_time > 0.0;
  plant::StateSpace plant_part = plant::to_state_space(antenna);
  plant::StateSpace motion;  // what moves by itself within a period
  if (sampled) {
    motion = plant::subsystem(plant_part, {"valve_command", "wind_torque"}, {"beam"});
  } else {
    motion = open_loop(antenna, antenna_form);
    if (delay == 0.0) {
      motion.a += motion.b.col(0) * motion.c.row(0);
      motion.b.col(0).setZero();
    }
  }
  const double whole = sampled ? antenna_form.sample_time : delay > 0.0 ? delay : without_delay;
  const double parts = parts_of(motion.a, whole);
  // A held command is no polynomial but a constant: there the period need not be cut for it, but
  // the beam's squares need their points.
  const Index cut = static_cast<Index>(parts);
  const Rule rule = gauss_rule(sampled ? points * cut : points);
  fraction_ = rule.fraction;
  weight_ = rule.weight;
  barycentric_ = rule.barycentric;
  period_ = sampled ? whole : whole / parts;
  const Index n = motion.a.rows(), count = fraction_.size();
  const Eigen::RowVectorXd c_boresight = motion.c.row(motion.c.rows() - 1);

  // State and constant inputs at the points, and at the end.
  std::vector<numerics::HeldTransition> to(static_cast<std::size_t>(count) + 1);
  for (Index i = 0; i <= count; ++i) {
    to[static_cast<std::size_t>(i)] =
        numerics::held_transition(motion.a, motion.b, period_ * (i < count ? fraction_[i] : 1.0));
  }

  if (sampled) {
    // States: plant, held command, controller.
    std::vector<std::string> measured = antenna_form.inputs;
    std::erase(measured, "rate_disturbance");
    const plant::StateSpace seen = plant::subsystem(plant_part, {"valve_command"}, measured);
    const plant::StateSpace k = plant::subsystem(antenna_form, measured, {"valve_demand"});
    const Index m = k.a.rows(), all = n + 1 + m;
    transition_ = MatrixXd::Zero(all, all);
    transition_.topLeftCorner(n, n) = to.back().state;
    transition_.col(n).head(n) = to.back().step.col(0);
    transition_.row(n).head(n) = k.d * seen.c;
    transition_.row(n).tail(m) = k.c;
    transition_.bottomLeftCorner(m, n) = k.b * seen.c;
    transition_.bottomRightCorner(m, m) = k.a;
    boresight_ = MatrixXd::Zero(count, all);
    for (Index i = 0; i < count; ++i) {
      const auto& here = to[static_cast<std::size_t>(i)];
      boresight_.row(i).head(n) = c_boresight * here.state;
      boresight_(i, n) = c_boresight * here.step.col(0);
    }
  } else {
    // States: plant and controller, then the demand at the points of the last periods, newest
    // first.
    const Index history = delay > 0.0 ? cut * count : 0, all = n + history;
    transition_ = MatrixXd::Zero(all, all);
    transition_.topLeftCorner(n, n) = to.back().state;
    boresight_ = MatrixXd::Zero(count, all);
    for (Index i = 0; i < count; ++i) {
      boresight_.row(i).head(n) = c_boresight * to[static_cast<std::size_t>(i)].state;
    }
    if (history > 0) {
      // exp(A s) B at the support points, s within the period.
      const Rule support = gauss_rule(supports);
      MatrixXd jolts(n, supports);
      for (Index i = 0; i < supports; ++i) {
        jolts.col(i) = numerics::matrix_exponential(motion.a * (period_ * support.fraction[i])) *
                       motion.b.col(0);
      }
      const auto driven = [&](double end) {  // n x count: by each cardinal polynomial
        MatrixXd result = MatrixXd::Zero(n, count);
        for (Index i = 0; i < supports; ++i) {
          const double before = end * support.fraction[i];
          result += end * period_ * support.weight[i] *
                    (jolts * cardinals(support.fraction, support.barycentric, before)) *
                    cardinals(fraction_, barycentric_, end - before).transpose();
        }
        return result;
      };
      const Eigen::RowVectorXd c_demand = motion.c.row(0);
      const Index oldest = n + history - count;
      transition_.block(0, oldest, n, count) = driven(1.0);
      for (Index i = 0; i < count; ++i) {
        const MatrixXd by_command = driven(fraction_[i]);
        boresight_.row(i).segment(oldest, count) = c_boresight * by_command;
        transition_.row(n + i).head(n) = c_demand * to[static_cast<std::size_t>(i)].state;
        transition_.row(n + i).segment(oldest, count) += c_demand * by_command;
      }
      for (Index i = count; i < history; ++i) transition_(n + i, n + i - count) = 1.0;
    }
  }
  const Index all = transition_.rows();
  step_ = VectorXd::Zero(all);
  step_.head(n) = to.back().step.col(1);
  impulse_ = VectorXd::Zero(all);
  impulse_.head(n) = motion.b.col(1);
  boresight_step_.resize(count);
  for (Index i = 0; i < count; ++i) {
    boresight_step_[i] = c_boresight * to[static_cast<std::size_t>(i)].step.col(1);
    if (!sampled && delay > 0.0) {
      const double demand = motion.c.row(0) * to[static_cast<std::size_t>(i)].step.col(1);
      step_[n + i] = demand;
    }
  }
  spectral_radius_ = numerics::spectral_radius(transition_);
}

double ClosedLoopResponse::abscissa() const {
  return std::log(spectral_radius_) / period_;
}

VectorXd ClosedLoopResponse::start(DisturbanceType course) const {
  return course == DisturbanceType::impulse ? impulse_ : VectorXd::Zero(impulse_.size());
}

double ClosedLoopResponse::between(const VectorXd& values, double fraction) const {
  return values.dot(cardinals(fraction_, barycentric_, fraction));
}

ResponseScore ClosedLoopResponse::score(DisturbanceType course,
                                        const ResponseOptions& options) const {
  if (!stable()) {
    throw NumericalFailure(fmt::format(
        "controlled course: expected a stable loop, found one whose slowest pole is at {:.3g} 1/s",
        abscissa()));
  }
  const Index all = transition_.rows();
  const bool step = course == DisturbanceType::step;
  ResponseScore result;
  VectorXd resting = VectorXd::Zero(all);
  if (step) {
    resting = numerics::linear_solve(MatrixXd::Identity(all, all) - transition_, step_,
                                     "one less the loop's map over a period");
    result.final_value = weight_.dot(boresight_ * resting + boresight_step_);
  }
  const MatrixXd cost = period_ * boresight_.transpose() * weight_.asDiagonal() * boresight_;
  const MatrixXd energy =
      solve_discrete_lyapunov(transition_.transpose(), cost, {.estimate_condition = false})
          .covariance;
  const VectorXd off = start(course) - resting;
  result.integral_squared_error = off.dot(energy * off);

  constexpr double decayed = 14.0;  // exp(-14) is 1e-6
  const double longest =
      std::min(options.longest, max_work / std::pow(static_cast<double>(all), 2) * period_);
  result.horizon = std::min(longest, decayed / -abscissa() + 20.0 * period_);
  const auto periods = static_cast<Index>(std::ceil(result.horizon / period_));
  std::vector<VectorXd> courses;
  courses.reserve(static_cast<std::size_t>(periods));
  VectorXd state = start(course), next(all);
  Index peak_period = 0;
  for (Index k = 0; k < periods; ++k) {
    VectorXd values = boresight_ * state;
    if (step) values += boresight_step_;
    const double largest = values.cwiseAbs().maxCoeff();
    if (largest > result.peak) {
      result.peak = largest;
      peak_period = k;
    }
    courses.push_back(std::move(values));
    next.noalias() = transition_ * state;
    if (step) next += step_;
    state.swap(next);
  }
  // Between the points, where the largest are: the polynomial of the period and of its neighbours.
  constexpr Index fine = 200;
  result.peak = 0.0;
  for (Index k = std::max<Index>(0, peak_period - 1); k <= std::min(periods - 1, peak_period + 1);
       ++k) {
    for (Index i = 0; i <= fine; ++i) {
      const double fraction = static_cast<double>(i) / fine;
      const double value = std::abs(between(courses[static_cast<std::size_t>(k)], fraction));
      if (value > result.peak) {
        result.peak = value;
        result.time_of_peak = (static_cast<double>(k) + fraction) * period_;
      }
    }
  }
  // Where the beam only comes near its end there is no peak to be timed.
  if (result.peak <= std::abs(result.final_value) * (1.0 + 1e-9)) {
    result.peak = std::abs(result.final_value);
    result.time_of_peak = std::numeric_limits<double>::infinity();
  }
  const double band = options.return_fraction * result.peak;
  const auto error = [&](Index k) {
    return (courses[static_cast<std::size_t>(k)].array() - result.final_value).abs().maxCoeff();
  };
  Index last = periods;
  for (Index k = periods; k-- > 0;) {
    result.largest_error = std::max(result.largest_error, error(k));
    if (last == periods && error(k) > band) last = k;
  }
  if (last == periods) {
    result.return_time = 0.0;
  } else if (last + 1 < periods) {
    // The last place beyond, from the end of its period back.
    for (Index i = fine; i >= 0; --i) {
      const double fraction = static_cast<double>(i) / fine;
      const double value =
          std::abs(between(courses[static_cast<std::size_t>(last)], fraction) - result.final_value);
      if (value <= band) continue;
      if (i == fine) {
        result.return_time = (static_cast<double>(last) + 1.0) * period_;
      } else {
        const double after = static_cast<double>(i + 1) / fine;
        const double later =
            std::abs(between(courses[static_cast<std::size_t>(last)], after) - result.final_value);
        const double cross = fraction + (after - fraction) * (value - band) / (value - later);
        result.return_time = (static_cast<double>(last) + cross) * period_;
      }
      break;
    }
  }
  return result;
}

std::vector<ResponseSample> ClosedLoopResponse::boresight(DisturbanceType course,
                                                          double duration) const {
  constexpr double maximum = 1e6;
  const double periods = std::ceil(duration / period_);
  if (!(duration > 0.0) || !(periods <= maximum)) {
    throw InvalidInput(fmt::format(
        "ClosedLoopResponse::beam: expected a duration above 0 and at most {:g} s, found {:g} s",
        maximum * period_, duration));
  }
  const bool step = course == DisturbanceType::step;
  std::vector<ResponseSample> result;
  result.reserve(static_cast<std::size_t>(periods) * static_cast<std::size_t>(fraction_.size()));
  VectorXd state = start(course);
  for (double k = 0.0; k < periods; ++k) {
    VectorXd values = boresight_ * state;
    if (step) values += boresight_step_;
    for (Index i = 0; i < values.size(); ++i) {
      result.push_back({(k + fraction_[i]) * period_, values[i]});
    }
    state = transition_ * state;
    if (step) state += step_;
  }
  return result;
}

}  // namespace boresight::control
