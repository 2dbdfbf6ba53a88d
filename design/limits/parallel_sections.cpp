#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr Index sensors = ParallelSections::sensors;
// Parameters of a section of second and of first order: denominator and numerators.
constexpr Index of_pair = 2 + 2 * sensors, of_single = 1 + sensors;
// How far within stability the conditions keep the poles.
constexpr double reserve = 2e-3;
// A pole with no more imaginary part than that, relative to it, is real.
constexpr double real_within = 1e-12;

// A pole in delta and its residues per sensor.
struct Pole {
  Complex place;
  Eigen::Vector3cd residue;
};

// Of a pair in delta, PoleBounds::damping: with b1 = -2 Re, b0 = |place|^2.
double damping_of(const Complex& place, double sample_time) {
  return -place.real() / std::abs(place) - 0.5 * sample_time * std::abs(place);
}

// The pair of that size in delta with that damping; none that is too fast for it.
std::optional<Complex> damped_pair(double size, double damping, double sample_time) {
  if (!(size < 2.0 * (0.999 - damping) / sample_time)) return std::nullopt;
  const double real = size * (damping + 0.5 * sample_time * size);
  return Complex(-real, std::sqrt(size * size - real * real));
}

}  // namespace

ParallelSections::ParallelSections(const plant::StateSpace& controller, const PoleBounds& bounds)
    : sample_time_(controller.sample_time), bounds_(bounds) {
  if (!(sample_time_ > 0.0)) {
    throw InvalidInput("parallel sections: expected a sampled controller, found a continuous one");
  }
  const plant::StateSpace own = from_sensors(controller);
  const auto modes = numerics::eigen_decomposition(own.a);
  if (own.a.rows() > 0 && !(modes.values.cwiseAbs().maxCoeff() < 1.0)) {
    throw InvalidInput(
        fmt::format("parallel sections: expected a controller that is stable by itself, found a "
                    "pole of magnitude {:.6f}",
                    modes.values.cwiseAbs().maxCoeff()));
  }
  const Eigen::MatrixXcd into = modes.left.adjoint() * own.b;
  const Eigen::RowVectorXcd out = own.c * modes.right;
  std::vector<Pole> real, upper;
  for (Index i = 0; i < modes.values.size(); ++i) {
    const Complex place = (modes.values[i] - 1.0) / sample_time_;
    const Eigen::Vector3cd residue = out[i] * into.row(i).transpose() / sample_time_;
    if (std::abs(place.imag()) <= real_within * std::abs(place)) {
      real.push_back({place.real(), residue});
    } else if (place.imag() > 0.0) {
      upper.push_back({place, residue});
    }
  }
  // Real poles pair up with the next in size; the slowest is left over.
  std::ranges::sort(real, {}, [](const Pole& one) { return std::abs(one.place); });
  singles_ = static_cast<Index>(real.size() % 2);
  pairs_ = static_cast<Index>(upper.size() + real.size() / 2);
  parameters_.resize(of_pair * pairs_ + of_single * singles_ + sensors);
  Index next = 0;
  const auto add = [&](const Pole& one, const Pole& other) {
    parameters_[next++] = std::log(-(one.place + other.place).real());
    parameters_[next++] = std::log((one.place * other.place).real());
    for (Index i = 0; i < sensors; ++i) {
      parameters_[next++] = (one.residue[i] + other.residue[i]).real();
      parameters_[next++] = -(one.residue[i] * other.place + other.residue[i] * one.place).real();
    }
  };
  for (const Pole& one : upper) add(one, {std::conj(one.place), one.residue.conjugate()});
  for (std::size_t i = real.size() % 2; i + 1 < real.size(); i += 2) add(real[i], real[i + 1]);
  if (singles_ == 1) {
    parameters_[next++] = std::log(-real.front().place.real());
    for (Index i = 0; i < sensors; ++i) parameters_[next++] = real.front().residue[i].real();
  }
  parameters_.tail(sensors) = own.d.transpose();
}

std::vector<Index> ParallelSections::logarithms() const {
  std::vector<Index> result;
  for (Index j = 0; j < pairs_; ++j) {
    result.push_back(of_pair * j);
    result.push_back(of_pair * j + 1);
  }
  if (singles_ == 1) result.push_back(of_pair * pairs_);
  return result;
}

plant::StateSpace ParallelSections::state_space(const Eigen::VectorXd& parameters) const {
  const Index states = order();
  plant::StateSpace result{Eigen::MatrixXd::Identity(states, states),
                           Eigen::MatrixXd::Zero(states, sensors),
                           Eigen::MatrixXd::Zero(1, states),
                           parameters.tail(sensors).transpose(),
                           SampledSetting::sensors(),
                           {"valve_command"},
                           {},
                           sample_time_};
  Index next = 0, row = 0;
  for (Index j = 0; j < pairs_; ++j, row += 2) {
    const double b1 = std::exp(parameters[next]), b0 = std::exp(parameters[next + 1]);
    const double size = std::sqrt(b0);
    next += 2;
    result.a(row, row) -= sample_time_ * b1;
    result.a(row, row + 1) = sample_time_ * size;
    result.a(row + 1, row) = -sample_time_ * size;
    for (Index i = 0; i < sensors; ++i) {
      result.b(row, i) = sample_time_ * parameters[next++];
      result.b(row + 1, i) = sample_time_ * parameters[next++] / size;
    }
    result.c(0, row) = 1.0;
  }
  if (singles_ == 1) {
    result.a(row, row) -= sample_time_ * std::exp(parameters[next++]);
    for (Index i = 0; i < sensors; ++i) result.b(row, i) = sample_time_ * parameters[next++];
    result.c(0, row) = 1.0;
  }
  for (Index i = 1; i <= states; ++i) result.states.push_back(fmt::format("section_state_{}", i));
  return result;
}

std::vector<Index> ParallelSections::parameters_of(Index sensor) const {
  std::vector<Index> result;
  Index next = 0;
  for (Index j = 0; j < pairs_; ++j, next += of_pair) {
    const Index numerator = next + 2 + 2 * sensor;
    result.insert(result.end(), {next, next + 1, numerator, numerator + 1});
  }
  if (singles_ == 1) result.insert(result.end(), {next, next + 1 + sensor});
  result.push_back(parameters_.size() - sensors + sensor);
  return result;
}

ParallelSections::Response ParallelSections::response(const Eigen::VectorXd& parameters,
                                                      const Eigen::ArrayXd& frequency) const {
  const Index count = frequency.size();
  Eigen::ArrayXcd delta(count);
  for (Index k = 0; k < count; ++k) {
    const double half = std::sin(0.5 * frequency[k] * sample_time_);
    delta[k] = Complex(-2.0 * half * half, std::sin(frequency[k] * sample_time_)) / sample_time_;
  }
  Response result;
  result.value.resize(count, sensors);
  for (Index i = 0; i < sensors; ++i) {
    result.value.col(i).setConstant(parameters[parameters.size() - sensors + i]);
    auto& derivative = result.by_parameters.at(static_cast<std::size_t>(i));
    derivative.resize(count, 4 * pairs_ + 2 * singles_ + 1);
    derivative.rightCols(1).setOnes();
  }
  Index next = 0, column = 0;  // of the parameters, of those of a sensor
  for (Index j = 0; j < pairs_; ++j, next += of_pair, column += 4) {
    const double b1 = std::exp(parameters[next]), b0 = std::exp(parameters[next + 1]);
    const Eigen::ArrayXcd inverse = (delta * (delta + b1) + b0).inverse();
    const Eigen::ArrayXcd rising = delta * inverse;
    for (Index i = 0; i < sensors; ++i) {
      const Index numerator = next + 2 + 2 * i;
      const Eigen::ArrayXcd part =
          parameters[numerator] * rising + parameters[numerator + 1] * inverse;
      result.value.col(i) += part;
      auto& derivative = result.by_parameters.at(static_cast<std::size_t>(i));
      derivative.col(column) = -b1 * part * rising;
      derivative.col(column + 1) = -b0 * part * inverse;
      derivative.col(column + 2) = rising;
      derivative.col(column + 3) = inverse;
    }
  }
  if (singles_ == 1) {
    const double b = std::exp(parameters[next]);
    const Eigen::ArrayXcd inverse = (delta + b).inverse();
    for (Index i = 0; i < sensors; ++i) {
      const Eigen::ArrayXcd part = parameters[next + 1 + i] * inverse;
      result.value.col(i) += part;
      auto& derivative = result.by_parameters.at(static_cast<std::size_t>(i));
      derivative.col(column) = -b * part * inverse;
      derivative.col(column + 1) = inverse;
    }
  }
  return result;
}

// z = 1 + T delta within the unit circle (Jury): b1 > T b0 and 4 > 2 T b1 - T^2 b0.
ParallelSections::Stability ParallelSections::stability(const Eigen::VectorXd& parameters) const {
  const double slowest = bounds_.slowest;
  const Index each = slowest > 0.0 ? 2 : 1;
  const Index count = each * order();
  Stability result{Eigen::VectorXd(count), Eigen::MatrixXd::Zero(count, parameters.size())};
  Index next = 0, row = 0;
  for (Index j = 0; j < pairs_; ++j, next += of_pair, row += 2 * each) {
    // Damped enough: b1 > T b0 + 2 damping sqrt(b0).
    const double undamped = sample_time_ * std::exp(parameters[next + 1]);
    const double damped = bounds_.damping * std::exp(0.5 * parameters[next + 1]);
    result.conditions[row] = std::log(undamped + 2.0 * damped) - parameters[next] + reserve;
    result.gradients(row, next) = -1.0;
    result.gradients(row, next + 1) = (undamped + damped) / (undamped + 2.0 * damped);
    const double first = 2.0 * sample_time_ * std::exp(parameters[next]);
    const double second = sample_time_ * sample_time_ * std::exp(parameters[next + 1]);
    result.conditions[row + 1] = first - second - 4.0 + reserve;
    result.gradients(row + 1, next) = first;
    result.gradients(row + 1, next + 1) = -second;
    if (each == 1) continue;
    // Real parts beyond s: b1 > 2 s, and for real poles b0 + s^2 > s b1.
    const double b0 = std::exp(parameters[next + 1]), square = slowest * slowest;
    result.conditions[row + 2] = std::log(2.0 * slowest) - parameters[next];
    result.gradients(row + 2, next) = -1.0;
    result.conditions[row + 3] = std::log(slowest) + parameters[next] - std::log(b0 + square);
    result.gradients(row + 3, next) = 1.0;
    result.gradients(row + 3, next + 1) = -b0 / (b0 + square);
  }
  if (singles_ == 1) {
    result.conditions[row] = parameters[next] + std::log(0.5 * sample_time_) + reserve;
    result.gradients(row, next) = 1.0;
    if (each == 2) {
      result.conditions[row + 1] = std::log(slowest) - parameters[next];
      result.gradients(row + 1, next) = -1.0;
    }
  }
  return result;
}

PoleBounds bounds_of(const plant::StateSpace& controller) {
  PoleBounds bounds{HUGE_VAL, HUGE_VAL};
  for (const Complex& pole : numerics::eigen_decomposition(controller.a).values) {
    const Complex place = (pole - 1.0) / controller.sample_time;
    bounds.slowest = std::min(bounds.slowest, -place.real());
    if (std::abs(place.imag()) <= real_within * std::abs(place)) continue;
    bounds.damping = std::min(bounds.damping, damping_of(place, controller.sample_time));
  }
  return bounds;
}

plant::StateSpace with_idle_pairs(const plant::StateSpace& controller,
                                  std::span<const double> frequencies, double damping) {
  const double time = controller.sample_time;
  plant::StateSpace result = from_sensors(controller);
  for (const double frequency : frequencies) {
    const auto pair = damped_pair(frequency, damping, time);
    if (!pair) continue;
    const Index row = result.a.rows(), all = row + 2;
    result.a.conservativeResizeLike(Eigen::MatrixXd::Zero(all, all));
    result.b.conservativeResizeLike(Eigen::MatrixXd::Zero(all, sensors));
    result.c.conservativeResizeLike(Eigen::MatrixXd::Zero(1, all));
    result.a.bottomRightCorner(2, 2).diagonal().setConstant(1.0 + time * pair->real());
    result.a(row, row + 1) = time * pair->imag();
    result.a(row + 1, row) = -time * pair->imag();
    result.c(0, row) = 1.0;
    for (Index i = 1; i <= 2; ++i) result.states.push_back(fmt::format("idle_{}", row + i));
  }
  return result;
}

}  // namespace boresight::design
