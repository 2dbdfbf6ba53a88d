#include <cmath>
#include <utility>

#include <boresight/design/verification/wind_course.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::design {

using Eigen::VectorXd;

namespace {

plant::StationarySeries part(const WindCondition& wind, plant::WindTorquePart which,
                             double interval, Eigen::Index samples) {
  return plant::wind_torque_series(wind.site, wind.model, which, wind.mean_speed,
                                   interval * static_cast<double>(samples), interval);
}

}  // namespace

ReferenceTrajectory steady_course(double interval, double rate, VectorXd wind_torque) {
  const Eigen::Index samples = wind_torque.size();
  return {interval,
          VectorXd::LinSpaced(samples, 0.0, rate * interval * static_cast<double>(samples - 1)),
          VectorXd::Constant(samples, rate), VectorXd::Zero(samples), std::move(wind_torque)};
}

WindCourses::WindCourses(const TrackingProblem& problem, const SimulatedLoop& loop, double rate,
                         double duration)
    : interval_(loop.sample_time),
      rate_(rate),
      gear_ratio_(loop.gear_ratio),
      mean_torque_(plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
                   loop.gear_ratio),
      samples_(static_cast<Eigen::Index>(std::llround(duration / interval_)) + 1),
      uniform_(part(problem.wind, plant::WindTorquePart::uniform, interval_, samples_)) {
  if (problem.wind.model == plant::WindModel::coherence) {
    gradient_.emplace(part(problem.wind, plant::WindTorquePart::gradient, interval_, samples_));
  }
}

// Seeds and streams as plant::synthesise_wind_torque has them.
VectorXd WindCourses::gusts(std::uint64_t seed) const {
  VectorXd torque = uniform_.draw(seed, 0);
  if (gradient_) torque += gradient_->draw(seed, 1);
  return torque.head(samples_) / gear_ratio_;
}

ReferenceTrajectory WindCourses::course(std::uint64_t seed) const {
  return steady_course(interval_, rate_, gusts(seed).array() + mean_torque_);
}

}  // namespace boresight::design
