#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/analysis/disk_margin.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/golden_section.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::control {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// (S - T)/2 = S - I/2 of a loop closed by -1.
plant::StateSpace half_difference(const plant::StateSpace& loop) {
  plant::validate(loop);
  const auto channels = static_cast<Eigen::Index>(loop.inputs.size());
  if (channels == 0 || channels != static_cast<Eigen::Index>(loop.outputs.size())) {
    throw InvalidInput(
        fmt::format("disk_margin: expected a loop with as many outputs as inputs, at least one, "
                    "found {} inputs and {} outputs",
                    loop.inputs.size(), loop.outputs.size()));
  }
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(channels, channels);
  const Eigen::MatrixXd direct =
      numerics::linear_solve(identity + loop.d, identity, "disk_margin: I + D");
  plant::StateSpace result = loop;
  result.a = loop.a - loop.b * direct * loop.c;
  result.b = loop.b * direct;
  result.c = -direct * loop.c;
  result.d = direct - 0.5 * identity;
  const bool sampled = loop.sample_time > 0.0;
  for (const auto pole : numerics::eigenvalues(result.a)) {
    const double outside = sampled ? std::abs(pole) - 1.0 : pole.real();
    if (!(outside < 0.0)) {
      throw NumericalFailure(
          fmt::format("disk_margin: the closed loop is not stable: pole at {:.6g} {:+.6g}j{}; "
                      "stabilise it first",
                      pole.real(), pole.imag(), sampled ? " (z)" : ""));
    }
  }
  return result;
}

// [0 K; -P 0]: from plant input and plant output, as they are perturbed, to what returns there.
plant::StateSpace both_sides(const plant::StateSpace& plant, const plant::StateSpace& controller) {
  plant::validate(plant);
  plant::validate(controller);
  if (plant.inputs.size() != controller.outputs.size() ||
      plant.outputs.size() != controller.inputs.size()) {
    throw InvalidInput(fmt::format(
        "disk_margin: expected a controller with the plant's {} outputs as inputs and its {} "
        "inputs as outputs, found {} and {}",
        plant.outputs.size(), plant.inputs.size(), controller.inputs.size(),
        controller.outputs.size()));
  }
  if (!plant.states.empty() && !controller.states.empty() &&
      plant.sample_time != controller.sample_time) {
    throw InvalidInput(fmt::format(
        "disk_margin: expected one sample time, found {} s (plant) and {} s (controller)",
        plant.sample_time, controller.sample_time));
  }
  const Eigen::Index n = plant.a.rows(), k = controller.a.rows();
  const Eigen::Index u = plant.b.cols(), y = plant.c.rows();
  plant::StateSpace loop;
  loop.a = Eigen::MatrixXd::Zero(n + k, n + k);
  loop.a.topLeftCorner(n, n) = plant.a;
  loop.a.bottomRightCorner(k, k) = controller.a;
  loop.b = Eigen::MatrixXd::Zero(n + k, u + y);
  loop.b.topLeftCorner(n, u) = plant.b;
  loop.b.bottomRightCorner(k, y) = controller.b;
  loop.c = Eigen::MatrixXd::Zero(u + y, n + k);
  loop.c.topRightCorner(u, k) = controller.c;
  loop.c.bottomLeftCorner(y, n) = -plant.c;
  loop.d = Eigen::MatrixXd::Zero(u + y, u + y);
  loop.d.topRightCorner(u, y) = controller.d;
  loop.d.bottomLeftCorner(y, u) = -plant.d;
  for (Eigen::Index i = 1; i <= n + k; ++i) loop.states.push_back(fmt::format("x{}", i));
  for (Eigen::Index i = 1; i <= u + y; ++i) {
    loop.inputs.push_back(fmt::format("u{}", i));
    loop.outputs.push_back(fmt::format("y{}", i));
  }
  loop.sample_time = n > 0 ? plant.sample_time : controller.sample_time;
  return loop;
}

// Largest singular value with the first `inputs` rows multiplied and columns divided by the factor
// that makes it smallest: of a convex function of ln factor, the minimum.
double balanced_gain(const Eigen::MatrixXcd& value, Eigen::Index inputs) {
  const Eigen::Index n = value.rows();
  const auto log_gain = [&](double log_factor) {
    Eigen::MatrixXcd scaled = value;
    scaled.topRows(inputs) *= std::exp(log_factor);
    scaled.leftCols(inputs) *= std::exp(-log_factor);
    return 0.5 * std::log(numerics::hermitian_eigen(scaled.adjoint() * scaled).values[n - 1]);
  };
  // Balanced where the two off-diagonal blocks are about equal.
  const double up = value.topRightCorner(inputs, n - inputs).norm();
  const double down = value.bottomLeftCorner(n - inputs, inputs).norm();
  if (!(up > 0.0) || !(down > 0.0)) {
    // Nothing goes round: the blocks count one by one.
    const auto largest = [](const Eigen::MatrixXcd& block) {
      const auto values = numerics::hermitian_eigen(block.adjoint() * block).values;
      return std::sqrt(values[values.size() - 1]);
    };
    return std::max(largest(value.topLeftCorner(inputs, inputs)),
                    largest(value.bottomRightCorner(n - inputs, n - inputs)));
  }
  const double middle = 0.5 * std::log(down / up);
  constexpr double reach = 3.0;
  const double best = numerics::golden_section_maximum([&](double x) { return -log_gain(x); },
                                                       middle - reach, middle + reach, 1e-7);
  return std::exp(log_gain(best));
}

}  // namespace

DiskMargin disk_margin_of(double alpha, double frequency) {
  const double half = 0.5 * alpha;
  return {alpha, frequency, std::isfinite(half) ? (1.0 - half) / (1.0 + half) : -1.0,
          half < 1.0 ? (1.0 + half) / (1.0 - half) : infinity,
          2.0 * std::atan(half) * 180.0 / std::numbers::pi};
}

DiskMargin disk_margin(const plant::StateSpace& loop) {
  const PeakGain peak = peak_gain(half_difference(loop));
  return disk_margin_of(1.0 / peak.upper, peak.frequency);
}

DiskMargin disk_margin(const plant::StateSpace& plant, const plant::StateSpace& controller) {
  const plant::StateSpace difference = half_difference(both_sides(plant, controller));
  const auto inputs = static_cast<Eigen::Index>(plant.inputs.size());
  plant::DenseResponse response(difference);
  Eigen::MatrixXcd value;
  const auto gain = [&](std::complex<double> s) {
    return response.evaluate(s, value) ? balanced_gain(value, inputs) : infinity;
  };
  const double time = difference.sample_time;
  const auto gain_at = [&](double w) {
    return gain(time > 0.0 ? std::polar(1.0, w * time) : std::complex<double>{0.0, w});
  };
  const Eigen::ArrayXd frequency = plant::response_grid(difference);
  const Eigen::ArrayXd gains = frequency.unaryExpr(gain_at);
  std::pair<double, double> peak{gain_at(0.0), 0.0};  // gain, frequency
  const auto include = [&](double value_there, double w) {
    if (value_there > peak.first) peak = {value_there, w};
  };
  for (Eigen::Index i = 0; i < frequency.size(); ++i) include(gains[i], frequency[i]);
  const double threshold = 0.8 * peak.first;
  for (Eigen::Index i = 1; i + 1 < frequency.size(); ++i) {
    if (gains[i] < threshold || gains[i] < gains[i - 1] || gains[i] <= gains[i + 1]) continue;
    const double x = numerics::golden_section_maximum(
        [&](double ln) { return gain_at(std::exp(ln)); }, std::log(frequency[i - 1]),
        std::log(frequency[i + 1]), 1e-8);
    include(gain_at(std::exp(x)), std::exp(x));
  }
  if (time == 0.0)
    include(balanced_gain(difference.d.cast<std::complex<double>>(), inputs), infinity);
  return disk_margin_of(1.0 / peak.first, peak.second);
}

}  // namespace boresight::control
