#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/analysis/loop_response.hpp>
#include <boresight/control/analysis/transmission_zeros.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

plant::StateSpace checked(const char* function, const plant::StateSpace& loop, double dead_time) {
  plant::validate(loop);
  if (loop.inputs.size() != 1 || loop.outputs.size() != 1) {
    throw InvalidInput(fmt::format(
        "{}: expected a loop of one input and one output, found {} and {}; choose a channel, or "
        "see disk_margin for several at once",
        function, loop.inputs.size(), loop.outputs.size()));
  }
  if (!(dead_time >= 0.0) || !std::isfinite(dead_time)) {
    throw InvalidInput(
        fmt::format("{}: expected a dead time of 0 or more, found {} s", function, dead_time));
  }
  return loop;
}

// Least and largest magnitude of what is not an integrator.
struct Range {
  double slowest = infinity;
  double fastest = 0.0;

  explicit Range(const Eigen::VectorXcd& features) {
    for (const auto feature : features) {
      const double magnitude = std::abs(feature);
      if (std::isfinite(magnitude)) fastest = std::max(fastest, magnitude);
    }
    for (const auto feature : features) {
      if (std::abs(feature) > 1e-14 * fastest) slowest = std::min(slowest, std::abs(feature));
    }
    if (fastest == 0.0) slowest = fastest = 1.0;
  }
};

Eigen::VectorXcd joined(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  Eigen::VectorXcd result(a.size() + b.size());
  result << a, b;
  return result;
}

// The reduction that `response` has not taken.
plant::DenseResponse::Start opposite(const plant::DenseResponse& response) {
  using Start = plant::DenseResponse::Start;
  return response.start() == Start::inputs ? Start::outputs : Start::inputs;
}

}  // namespace

LoopResponse::LoopResponse(const char* function, const plant::StateSpace& loop, double dead_time)
    : scaled_(plant::balanced(checked(function, loop, dead_time))),
      response_(loop),
      other_(loop, opposite(response_)),
      dead_time_(dead_time) {
  const bool sampled = loop.sample_time > 0.0;
  if (sampled) scaled_.a.diagonal().array() -= 1.0;
  features_ = numerics::eigenvalues(scaled_.a);
  const double feedthrough = loop.d(0, 0);
  if (std::abs(1.0 + feedthrough) > 1e-12 * (1.0 + std::abs(feedthrough))) {
    const Eigen::MatrixXd closed = scaled_.a - scaled_.b * scaled_.c / (1.0 + feedthrough);
    const Eigen::VectorXcd poles = numerics::eigenvalues(closed);
    if (dead_time == 0.0) {
      closed_loop_stable_ = std::all_of(poles.begin(), poles.end(), [&](Complex pole) {
        return sampled ? std::abs(1.0 + pole) < 1.0 : pole.real() < 0.0;
      });
    }
    features_ = joined(features_, poles);
  }
  const Range range(features_);
  if (sampled) features_.array() += 1.0;
  features_ = joined(features_, transmission_zeros(loop));

  at_zero_ = real_end(0.0);
  // An integrator with rounding errors can come out as a finite number.
  const double near_zero =
      1e-3 * (sampled ? std::min(range.slowest, 1.0) / loop.sample_time : range.slowest);
  const Complex nearby = at(near_zero);
  if (!(std::abs(nearby - at_zero_) < 0.1 * (std::abs(at_zero_) + std::abs(nearby)))) {
    if (std::abs(nearby) > std::abs(at_zero_) || !std::isfinite(std::abs(nearby))) {
      at_zero_ = infinity;
    }
  }
  at_highest_ = sampled ? real_end(-2.0) : feedthrough;
}

// L at s, or z - 1, by elimination: O(n^3), but no digits of slow poles are lost beside fast ones.
Complex LoopResponse::solved(Complex s) const {
  return numerics::transfer_matrix(scaled_.a, scaled_.b, scaled_.c, scaled_.d, s)(0, 0);
}

Complex LoopResponse::real_end(double s) {
  Eigen::MatrixXcd value;
  if (!response_.evaluate(sample_time() > 0.0 ? 1.0 + s : s, value)) return infinity;
  return solved(s);
}

// Relative error of the response against elimination, largest of some points close together.
double LoopResponse::error_at(double angular_frequency) {
  constexpr double apart = 1e-7, caution = 8.0;
  double largest = 0.0;
  for (const double w :
       {angular_frequency * (1.0 - apart), angular_frequency, angular_frequency * (1.0 + apart)}) {
    Complex s{0.0, w};
    if (sample_time() > 0.0) {
      const double half = std::sin(0.5 * w * sample_time());
      s = {-2.0 * half * half, std::sin(w * sample_time())};
    }
    const Complex value = response_.channel(w);
    largest = std::max(largest, std::abs(value - solved(s)) / std::abs(value));
  }
  return std::isfinite(largest) ? caution * largest : 1.0;
}

Eigen::VectorXcd LoopResponse::continuous_features() const {
  return sample_time() > 0.0 ? plant::continuous_equivalent(features_, sample_time()) : features_;
}

Complex LoopResponse::at(double angular_frequency) {
  const Complex value = response_.channel(angular_frequency);
  return dead_time_ > 0.0 ? value * std::polar(1.0, -angular_frequency * dead_time_) : value;
}

Eigen::ArrayXcd LoopResponse::at(const Eigen::ArrayXd& angular_frequency) {
  Eigen::ArrayXcd value;
  response_.evaluate(angular_frequency, value);
  if (dead_time_ > 0.0) {
    for (Eigen::Index i = 0; i < value.size(); ++i) {
      value[i] *= std::polar(1.0, -angular_frequency[i] * dead_time_);
    }
  }
  return value;
}

LoopOnGrid LoopResponse::on_grid(Eigen::ArrayXd angular_frequency) {
  const Eigen::Index count = angular_frequency.size();
  LoopOnGrid result;
  result.gain = [this](double w) { return at(w); };
  result.error = [this](double w) { return error_at(w); };
  result.value = at(angular_frequency);
  Eigen::ArrayXcd other;
  other_.evaluate(angular_frequency, other);
  Eigen::ArrayXd raw(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (dead_time_ > 0.0) other[i] *= std::polar(1.0, -angular_frequency[i] * dead_time_);
    raw[i] = std::abs(other[i] - result.value[i]) / std::abs(result.value[i]);
    if (!std::isfinite(raw[i])) raw[i] = 1.0;
  }
  // Two roundings can agree by chance at one point, hardly at seven in a row.
  constexpr Eigen::Index reach = 3;
  constexpr double neighbourhood = 1.3, minimum = 1e-13, caution = 32.0;
  result.uncertainty.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double w = angular_frequency[i];
    double largest = raw[i];
    for (Eigen::Index k = std::max<Eigen::Index>(0, i - reach); k <= std::min(count - 1, i + reach);
         ++k) {
      const double other_w = angular_frequency[k];
      if (std::max(w, other_w) < neighbourhood * std::min(w, other_w)) {
        largest = std::max(largest, raw[k]);
      }
    }
    result.uncertainty[i] = minimum + caution * largest;
  }
  result.frequency = std::move(angular_frequency);
  return result;
}

void LoopResponse::add_real_ends(std::vector<PhaseCrossover>& crossovers) const {
  const auto counts = [](double value) { return std::isfinite(value) && value < 0.0; };
  if (counts(at_zero_.real())) {
    crossovers.insert(crossovers.begin(), {0.0, -1.0 / at_zero_.real()});
  }
  double last = at_highest_.real();
  if (sample_time() > 0.0) {
    // Real with the dead time too where that is a whole number of samples.
    const double samples = dead_time_ / sample_time();
    if (samples != std::round(samples)) return;
    if (std::fmod(samples, 2.0) != 0.0) last = -last;
  } else if (dead_time_ > 0.0) {
    last = -std::abs(last);  // turns for ever
  }
  if (counts(last)) crossovers.push_back({nyquist_frequency(), -1.0 / last});
}

double LoopResponse::nyquist_frequency() const {
  return sample_time() > 0.0 ? std::numbers::pi / sample_time() : infinity;
}

}  // namespace boresight::control
