#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include <boresight/design/commissioning/wind_error_fit.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/golden_section.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::design {
namespace {

constexpr int min_records = 3;

using Matrix = Eigen::Matrix<double, 6, 6>;
using Vector = Eigen::Matrix<double, 6, 1>;

double square(double value) {
  return value * value;
}

void check(const std::vector<ErrorInWind>& records, double reference) {
  const auto after = std::ranges::count(records, true, &ErrorInWind::after);
  const auto before = static_cast<std::ptrdiff_t>(records.size()) - after;
  if (before < min_records || after < min_records) {
    throw InvalidInput(
        fmt::format("WindErrorFit: expected at least {} records of each condition, found {} before "
                    "and {} after",
                    min_records, before, after));
  }
  const bool usable = std::ranges::all_of(records, [](const ErrorInWind& one) {
    return one.variance > 0.0 && one.freedom > 0.0 && one.speed > 0.0 &&
           std::isfinite(one.variance + one.freedom + one.speed + one.log_gusts);
  });
  if (!usable || !(reference > 0.0) || !std::isfinite(reference)) {
    throw InvalidInput(
        "WindErrorFit: expected positive finite variances, degrees of freedom and wind speeds, "
        "found others");
  }
}

}  // namespace

WindErrorFit::WindErrorFit(std::vector<ErrorInWind> records, double reference_speed)
    : records_(std::move(records)), reference_(reference_speed) {
  check(records_, reference_speed);
  std::vector<double> freedom, variances;
  for (const ErrorInWind& one : records_) {
    freedom.push_back(one.freedom);
    variances.push_back(one.variance);
  }
  const double median = numerics::median(freedom);
  for (const double one : freedom) weight_.push_back(2.0 * one / (one + median));
  scale_ = numerics::median(variances);
  dispersion_ = 2.0 / median;
  // The weight of the priors depends on the dispersion, which hardly depends on them.
  for (int i = 0; i < 3; ++i) {
    minimise();
    estimate_dispersion();
  }
}

double WindErrorFit::forcing(const ErrorInWind& record, double exponent,
                             double gust_exponent) const {
  return std::exp(exponent * std::log(record.speed / reference_) +
                  gust_exponent * record.log_gusts);
}

// Weighted least squares, repeated with the weights of the new means.
WindErrorFit::Line WindErrorFit::fitted_line(bool after, double exponent,
                                             double gust_exponent) const {
  constexpr int most_iterations = 200;
  Line line;
  std::vector<double> forcings;
  for (const ErrorInWind& record : records_) {
    forcings.push_back(forcing(record, exponent, gust_exponent));
    if (record.after == after) {
      line.wind = std::max(line.wind, record.variance / scale_ / forcings.back());
    }
  }
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double w00 = 0.0, w01 = 0.0, w11 = 0.0, r0 = 0.0, r1 = 0.0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (records_[i].after != after) continue;
      const double x = forcings[i];
      const double weight = weight_[i] / square(line.still + line.wind * x);
      const double value = records_[i].variance / scale_;
      w00 += weight;
      w01 += weight * x;
      w11 += weight * x * x;
      r0 += weight * value;
      r1 += weight * x * value;
    }
    const double determinant = w00 * w11 - w01 * w01;
    Line next;
    if (determinant > 1e-12 * w00 * w11) {
      next = {(r0 * w11 - r1 * w01) / determinant, (r1 * w00 - r0 * w01) / determinant};
    } else {
      next = {-1.0, 0.0};  // all in the same wind: no error in still air to tell from it
    }
    if (next.still < 0.0) next = {0.0, r1 / w11};
    if (next.wind < 0.0) next = {r0 / w00, 0.0};
    const double change = std::abs(next.still - line.still) + std::abs(next.wind - line.wind);
    // Half steps at first keep the weights from swinging.
    const double step = iteration < 8 ? 0.5 : 1.0;
    line.still += step * (next.still - line.still);
    line.wind += step * (next.wind - line.wind);
    if (change < 1e-13 * (line.still + line.wind)) break;
  }
  return line;
}

double WindErrorFit::deviance(double exponent, double gust_exponent) const {
  const std::array lines{fitted_line(false, exponent, gust_exponent),
                         fitted_line(true, exponent, gust_exponent)};
  double sum =
      dispersion_ * (square((exponent - usual_wind_exponent) / usual_wind_exponent_deviation) +
                     square((gust_exponent - usual_gust_exponent) / usual_gust_exponent_deviation));
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Line& line = lines.at(records_[i].after ? 1 : 0);
    const double mean =
        scale_ * (line.still + line.wind * forcing(records_[i], exponent, gust_exponent));
    const double ratio = records_[i].variance / mean;
    sum += 2.0 * weight_[i] * (ratio - 1.0 - std::log(ratio));
  }
  return sum;
}

void WindErrorFit::minimise() {
  constexpr double reach = 4.0;  // standard deviations of the priors
  constexpr double tolerance = 1e-6;
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    exponent_ = numerics::golden_section_maximum(
        [&](double exponent) { return -deviance(exponent, gust_exponent_); },
        usual_wind_exponent - reach * usual_wind_exponent_deviation,
        usual_wind_exponent + reach * usual_wind_exponent_deviation, tolerance);
    gust_exponent_ = numerics::golden_section_maximum(
        [&](double exponent) { return -deviance(exponent_, exponent); },
        usual_gust_exponent - reach * usual_gust_exponent_deviation,
        usual_gust_exponent + reach * usual_gust_exponent_deviation, tolerance);
  }
  line_ = {fitted_line(false, exponent_, gust_exponent_),
           fitted_line(true, exponent_, gust_exponent_)};
}

// Pearson's, and the covariance of the parameters.
void WindErrorFit::estimate_dispersion() {
  Matrix information = Matrix::Zero();
  double pearson = 0.0, sampling = 0.0;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const ErrorInWind& record = records_[i];
    const std::size_t side = record.after ? 1 : 0;
    const double x = forcing(record, exponent_, gust_exponent_);
    const double wind = line_.at(side).wind * x;
    const double mean = line_.at(side).still + wind;
    Vector gradient = Vector::Zero();
    gradient[static_cast<Eigen::Index>(2 * side)] = 1.0 / mean;
    gradient[static_cast<Eigen::Index>(2 * side + 1)] = x / mean;
    gradient[4] = wind / mean * std::log(record.speed / reference_);
    gradient[5] = wind / mean * record.log_gusts;
    information += weight_[i] * gradient * gradient.transpose();
    pearson += weight_[i] * square(record.variance / scale_ / mean - 1.0);
    sampling += 2.0 / record.freedom / static_cast<double>(records_.size());
  }
  // A parameter at its bound is known there.
  double free = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::array values{line_.at(side).still, line_.at(side).wind};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto place = static_cast<Eigen::Index>(2 * side + k);
      if (values.at(k) > 0.0) {
        free += 1.0;
        continue;
      }
      information.row(place).setZero();
      information.col(place).setZero();
      information(place, place) = 1e300;
    }
  }
  const std::array prior{dispersion_ / square(usual_wind_exponent_deviation),
                         dispersion_ / square(usual_gust_exponent_deviation)};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto place = static_cast<Eigen::Index>(4 + k);
    free += information(place, place) / (information(place, place) + prior.at(k));
    information(place, place) += prior.at(k);
  }
  residual_freedom_ = std::max(1.0, static_cast<double>(records_.size()) - free);
  dispersion_ = std::max(pearson / residual_freedom_, sampling);
  // Scaled to a unit diagonal for the inverse.
  const Vector diagonal = information.diagonal().cwiseSqrt();
  const Matrix scaled =
      diagonal.cwiseInverse().asDiagonal() * information * diagonal.cwiseInverse().asDiagonal();
  const Matrix inverse = scaled.ldlt().solve(Matrix::Identity());
  covariance_.assign(static_cast<std::size_t>(parameters) * static_cast<std::size_t>(parameters),
                     0.0);
  Eigen::Map<Matrix>(covariance_.data()) = dispersion_ * diagonal.cwiseInverse().asDiagonal() *
                                           inverse * diagonal.cwiseInverse().asDiagonal();
}

// Of half the logarithm of the mean variance.
WindErrorFit::Gradient WindErrorFit::log_gradient(bool after, double speed) const {
  const std::size_t side = after ? 1 : 0;
  const double log_speed = std::log(speed / reference_);
  const double x = std::exp(exponent_ * log_speed);
  const Line& line = line_.at(side);
  const double mean = line.still + line.wind * x;
  Gradient gradient{};
  gradient.at(2 * side) = 0.5 / mean;
  gradient.at(2 * side + 1) = 0.5 * x / mean;
  gradient.at(4) = 0.5 * line.wind * x / mean * log_speed;
  return gradient;
}

double WindErrorFit::standard_error(const Gradient& gradient) const {
  const Eigen::Map<const Vector> vector(gradient.data());
  const Eigen::Map<const Matrix> covariance(covariance_.data());
  return std::sqrt(std::max(0.0, vector.dot(covariance * vector)));
}

RmsBand WindErrorFit::error(bool after, double speed, double confidence) const {
  const Line& line = line_.at(after ? 1 : 0);
  const double x = std::exp(exponent_ * std::log(speed / reference_));
  const double rms = std::sqrt(scale_ * (line.still + line.wind * x));
  const double half = numerics::student_quantile(0.5 + 0.5 * confidence, residual_freedom_) *
                      standard_error(log_gradient(after, speed));
  return {rms, rms * std::exp(-half), rms * std::exp(half)};
}

RatioBand WindErrorFit::ratio(double speed, double confidence) const {
  Gradient gradient = log_gradient(true, speed);
  const Gradient before = log_gradient(false, speed);
  for (std::size_t k = 0; k < gradient.size(); ++k) gradient.at(k) -= before.at(k);
  const double value = error(true, speed, confidence).value / error(false, speed, confidence).value;
  const double half = numerics::student_quantile(0.5 + 0.5 * confidence, residual_freedom_) *
                      standard_error(gradient);
  return {value, value * std::exp(-half), value * std::exp(half)};
}

double WindErrorFit::still_air_rms(bool after) const {
  return std::sqrt(scale_ * line_.at(after ? 1 : 0).still);
}

}  // namespace boresight::design
