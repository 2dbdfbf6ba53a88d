#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <boresight/design/commissioning/oil_flow.hpp>
#include <boresight/design/commissioning/step_responses.hpp>
#include <boresight/identification/signals/rate_smoothing.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::ServoRecord;
using identification::Signal;

// Least pressure left at the orifice, of the supply's.
constexpr double least_drop = 0.05;
constexpr double largest_relative_uncertainty = 0.2;

VectorXd integral_of(const VectorXd& values, double sample_time) {
  VectorXd result = VectorXd::Zero(values.size());
  for (Index k = 1; k < values.size(); ++k) {
    result[k] = result[k - 1] + 0.5 * sample_time * (values[k] + values[k - 1]);
  }
  return result;
}

VectorXd delayed(const VectorXd& values, double samples) {
  VectorXd result(values.size());
  const auto whole = static_cast<Index>(samples);
  const double part = samples - static_cast<double>(whole);
  for (Index k = 0; k < values.size(); ++k) {
    const double now = values[std::max<Index>(0, k - whole)];
    const double before = values[std::max<Index>(0, k - whole - 1)];
    result[k] = (1.0 - part) * now + part * before;
  }
  return result;
}

// Without the samples whose window is not whole.
VectorXd less_average(const VectorXd& values, Index reach) {
  return (values - identification::moving_mean(values, reach))
      .segment(reach, values.size() - 2 * reach);
}

}  // namespace

Signal valve_flow(const ServoRecord& record, const FlowModel& model) {
  Signal flow = *record.valve_command;
  const VectorXd& torque = record.motor_torque->values;
  for (Index k = 0; k < flow.values.size(); ++k) {
    const double load = std::copysign(torque[k], torque[k] * flow.values[k]) / model.supply_torque;
    flow.values[k] *= std::sqrt(std::max(1.0 - load, least_drop));
    if (!record.motor_torque->is_valid(k) && flow.valid.empty()) {
      flow.valid.assign(static_cast<std::size_t>(flow.values.size()), true);
    }
    if (!record.motor_torque->is_valid(k)) flow.valid[static_cast<std::size_t>(k)] = false;
  }
  return flow;
}

std::optional<OilSpring> oil_spring(const ServoRecord& record, const FlowModel& model) {
  if (!record.motor_torque || !record.motor_rate || !record.valve_command) return std::nullopt;
  const Index samples = record.motor_rate->values.size();
  const double time = record.sample_time;
  const auto reach = static_cast<Index>(std::ceil(0.5 * model.window / time));
  constexpr Index fewest_windows = 4;
  if (samples < fewest_windows * 2 * reach) return std::nullopt;
  // The load at the orifice when the flow has come.
  ServoRecord late = record;
  late.valve_command->values = delayed(record.valve_command->values, model.delay / time);
  const Signal flow = valve_flow(late, model);
  for (const Signal* one : {&flow, &*record.motor_rate}) {
    if (!all_valid(*one, 0, samples)) return std::nullopt;
  }
  const VectorXd torque = delayed(record.motor_torque->values, model.tachometer_lag / time);
  const VectorXd later = delayed(flow.values, model.tachometer_lag / time);
  Eigen::MatrixXd terms(samples - 2 * reach, 3);
  terms.col(0) = less_average(integral_of(later, time), reach);
  terms.col(1) = less_average(integral_of(record.motor_rate->values, time), reach);
  terms.col(2) = less_average(integral_of(torque, time), reach);
  const VectorXd shown = less_average(torque, reach);
  const Eigen::RowVectorXd scale = terms.colwise().norm();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::MatrixXd scaled = terms.array().rowwise() / scale.array();
  const VectorXd factors = scaled.colPivHouseholderQr().solve(shown);
  const VectorXd rest = shown - scaled * factors;
  const double correlated = std::max(1.0, 0.25 * static_cast<double>(reach));
  const double variance =
      correlated * rest.squaredNorm() / static_cast<double>(shown.size() - terms.cols());
  const Eigen::MatrixXd covariance =
      (scaled.transpose() * scaled).ldlt().solve(Eigen::MatrixXd::Identity(3, 3)) * variance;
  const OilSpring spring{-factors[1] / scale[1], std::sqrt(covariance(1, 1)) / scale[1]};
  const bool is_identifiable = spring.stiffness > 0.0 &&
                               spring.uncertainty < largest_relative_uncertainty * spring.stiffness;
  return is_identifiable ? std::optional(spring) : std::nullopt;
}

}  // namespace boresight::design
