#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/complex_packs.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

// As many frequencies as are handed over at a time.
constexpr int lane_count = 8;
constexpr std::size_t bytes_of_double = sizeof(double);

// Numbers in the work arrays, one Lane after the other, of any alignment.
template <typename Lane>
struct Work {
  static constexpr Eigen::Index width = sizeof(Lane) / bytes_of_double;

  [[gnu::always_inline]] static inline void load(Lane& lane, const double* work, Eigen::Index i) {
    std::memcpy(&lane, work + i * width, sizeof(Lane));
  }
  [[gnu::always_inline]] static inline void store(const Lane& lane, double* work, Eigen::Index i) {
    std::memcpy(work + i * width, &lane, sizeof(Lane));
  }
};

template <typename Lane>
[[gnu::always_inline]] inline void set_magnitude(Lane& out, const Lane& value) {
  out = value < 0.0 ? -value : value;
}

// Where x outgrows this, all of it is scaled down: a common factor of x does not matter.
constexpr double growth_limit = 0x1p+200;
constexpr double growth_scale = 0x1p-400;

[[gnu::always_inline]] inline bool any_above(double magnitude, double limit) {
  return magnitude > limit;
}
template <typename Lanes>
[[gnu::always_inline]] inline bool any_above(const Lanes& magnitude, double limit) {
  double largest = magnitude[0];
  for (Eigen::Index l = 1; l < Work<Lanes>::width; ++l) largest = std::max(largest, magnitude[l]);
  return largest > limit;
}

// Turns A into Hessenberg form and b into a multiple of the first unit vector by elementary
// transformations with pivoting, and takes C along; returns how many states b reaches.
Eigen::Index reduce(Eigen::MatrixXd& a, Eigen::VectorXd& b, Eigen::MatrixXd& c) {
  const Eigen::Index n = a.rows();
  Eigen::VectorXd multipliers(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    // The column whose elements below k are to vanish; `before` is the column of A that it is.
    const Eigen::Index before = k - 1;
    Eigen::Map<Eigen::VectorXd> column(k == 0 ? b.data() : a.col(before).data(), n);
    Eigen::Index pivot = 0;
    const double largest = column.tail(n - k).cwiseAbs().maxCoeff(&pivot);
    pivot += k;
    const double neighbours =
        k == 0 ? 0.0 : std::abs(a(before, before)) + std::abs(a(pivot, pivot));
    if (!(largest > epsilon * neighbours)) return k;
    if (pivot != k) {
      std::swap(column[pivot], column[k]);
      a.row(pivot).tail(n - k).swap(a.row(k).tail(n - k));
      a.col(pivot).swap(a.col(k));
      c.col(pivot).swap(c.col(k));
    }
    const Eigen::Index below = n - k - 1;
    auto multiplier = multipliers.head(below);
    multiplier = column.tail(below) / column[k];
    column.tail(below).setZero();
    a.bottomRightCorner(below, n - k).noalias() -= multiplier * a.row(k).tail(n - k);
    a.col(k).noalias() += a.rightCols(below) * multiplier;
    c.col(k).noalias() += c.rightCols(below) * multiplier;
  }
  return n;
}

// What a substitution leaves: the element of the first row, the size of the terms it is the sum
// of, and the output that scales with x.
template <typename Lane>
struct Substitution {
  Lane pivot_re, pivot_im, size, output_re, output_im;
};

// output entry/pivot, the pivot scaled against overflow; infinite where the pivot is rounding.
Complex quotient(Eigen::Index order, double entry, Complex output, Complex pivot, double size) {
  const double largest = std::max(std::abs(pivot.real()), std::abs(pivot.imag()));
  if (!(largest > static_cast<double>(order) * epsilon * size)) return {infinity, 0.0};
  return output / largest * entry / (pivot / largest);
}

}  // namespace

struct HymanSubstitution {
  // x of (s I - H) x = pivot e_1 with the last element 1, into `work`: last element first, real
  // and imaginary parts alternating.
  template <typename Lane>
  [[gnu::always_inline]] static inline void states(const DenseResponse::Reach& reach,
                                                   const Lane& s_re, const Lane& s_im, double* work,
                                                   Substitution<Lane>& result) {
    using X = Work<Lane>;
    const double* h = reach.elements.data();
    const Eigen::Index last = reach.order - 1;
    const Lane zero = s_re * 0.0;
    Lane x_re = zero + 1.0, x_im = zero;
    X::store(x_re, work, 0);
    X::store(x_im, work, 1);
    for (Eigen::Index i = 0; i < last; ++i) {
      Lane sum_re = zero, sum_im = zero, other;
      for (Eigen::Index j = 0; j < i; ++j, ++h) {
        X::load(other, work, 2 * j);
        sum_re += *h * other;
        X::load(other, work, 2 * j + 1);
        sum_im += *h * other;
      }
      const Lane shift = s_re - *h++;
      const double inverse = *h++;
      const Lane next_re = (shift * x_re - s_im * x_im - sum_re) * inverse;
      x_im = (shift * x_im + s_im * x_re - sum_im) * inverse;
      x_re = next_re;
      X::store(x_re, work, 2 * i + 2);
      X::store(x_im, work, 2 * i + 3);
      Lane magnitude, magnitude_im;
      set_magnitude(magnitude, x_re);
      set_magnitude(magnitude_im, x_im);
      magnitude += magnitude_im;
      if (any_above(magnitude, growth_limit)) {
        const Lane one = zero + 1.0;
        const Lane scale = magnitude > growth_limit ? one * growth_scale : one;
        for (Eigen::Index j = 0; j < 2 * i + 4; ++j) {
          X::load(other, work, j);
          X::store(other * scale, work, j);
        }
        x_re *= scale;
        x_im *= scale;
      }
    }
    Lane sum_re = zero, sum_im = zero, size = zero, other, magnitude;
    for (Eigen::Index j = 0; j < last; ++j, ++h) {
      X::load(other, work, 2 * j);
      other *= *h;
      sum_re += other;
      set_magnitude(magnitude, other);
      size += magnitude;
      X::load(other, work, 2 * j + 1);
      other *= *h;
      sum_im += other;
      set_magnitude(magnitude, other);
      size += magnitude;
    }
    const Lane shift = s_re - *h;
    result.pivot_re = shift * x_re - s_im * x_im - sum_re;
    result.pivot_im = shift * x_im + s_im * x_re - sum_im;
    Lane s_size, x_size;
    set_magnitude(s_size, s_re);
    set_magnitude(magnitude, s_im);
    s_size += magnitude + std::abs(*h);
    set_magnitude(x_size, x_re);
    set_magnitude(magnitude, x_im);
    x_size += magnitude;
    result.size = size + s_size * x_size;
  }

  template <typename Lane>
  [[gnu::always_inline]] static inline void output(const DenseResponse::Reach& reach,
                                                   Eigen::Index row, const double* work,
                                                   Substitution<Lane>& result) {
    const double* c = reach.output.data() + row * reach.order;
    Lane re, im, other;
    Work<Lane>::load(re, work, 0);
    Work<Lane>::load(im, work, 1);
    re *= c[0];
    im *= c[0];
    for (Eigen::Index j = 1; j < reach.order; ++j) {
      Work<Lane>::load(other, work, 2 * j);
      re += c[j] * other;
      Work<Lane>::load(other, work, 2 * j + 1);
      im += c[j] * other;
    }
    result.output_re = re;
    result.output_im = im;
  }

  // `s`: real parts of lane_count points, then the imaginary ones; `result`: likewise the numbers
  // of a Substitution.
  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(const DenseResponse::Reach& reach, const double* s,
                                                Eigen::Index row, double* work, double* result) {
    using Lanes = typename numerics::RealLanes<width>::Lanes;
    for (Eigen::Index first = 0; first < lane_count; first += width) {
      Lanes s_re, s_im;
      Work<Lanes>::load(s_re, s + first, 0);
      Work<Lanes>::load(s_im, s + lane_count + first, 0);
      Substitution<Lanes> sums{};
      states(reach, s_re, s_im, work, sums);
      output(reach, row, work, sums);
      double* place = result + first;
      for (const Lanes& sum :
           {sums.pivot_re, sums.pivot_im, sums.size, sums.output_re, sums.output_im}) {
        Work<Lanes>::store(sum, place, 0);
        place += lane_count;
      }
    }
  }
};

DenseResponse::DenseResponse(const StateSpace& system, Start start)
    : order_(system.a.rows()), sample_time_(system.sample_time), feedthrough_(system.d) {
  validate(system);
  StateSpace scaled = balanced(system);
  if (sample_time_ > 0.0) scaled.a.diagonal().array() -= 1.0;
  work_.resize(static_cast<std::size_t>(2 * order_ * lane_count));
  start_ = start == Start::outputs ? Start::outputs : Start::inputs;
  reach_ = start_ == Start::inputs
               ? reaches(scaled.a, scaled.b, scaled.c)
               : reaches(scaled.a.transpose(), scaled.c.transpose(), scaled.b.transpose());
  if (start == Start::better && order_ > 1) choose_start(scaled);
}

std::vector<DenseResponse::Reach> DenseResponse::reaches(const Eigen::MatrixXd& a,
                                                         const Eigen::MatrixXd& b,
                                                         const Eigen::MatrixXd& c) {
  std::vector<Reach> result;
  for (Eigen::Index input = 0; input < b.cols(); ++input) {
    Eigen::MatrixXd h = a, rows = c;
    Eigen::VectorXd column = b.col(input);
    Reach reach;
    reach.order = reduce(h, column, rows);
    reach.entry = reach.order > 0 ? column[0] : 0.0;
    for (Eigen::Index i = reach.order - 1; i >= 0; --i) {
      for (Eigen::Index j = reach.order - 1; j >= i; --j) reach.elements.push_back(h(i, j));
      if (i > 0) reach.elements.push_back(1.0 / h(i, i - 1));
    }
    // In the order of x: last state first.
    reach.output = rows.leftCols(reach.order).rowwise().reverse().transpose();
    result.push_back(std::move(reach));
  }
  return result;
}

// Compares the reduction from the inputs, which is there, with that from the outputs at some
// frequencies, and where they differ with linear solves.
void DenseResponse::choose_start(const StateSpace& scaled) {
  constexpr int probes = 25, probes_per_decade = 3;
  constexpr double sound = 1e-8;  // relative error
  const double fastest = sample_time_ > 0.0 ? std::numbers::pi / sample_time_
                                            : scaled.a.cwiseAbs().colwise().sum().maxCoeff();
  if (!(fastest > 0.0)) return;
  const auto error = [](const Eigen::MatrixXcd& found, const Eigen::MatrixXcd& expected) {
    const Eigen::ArrayXXd relative =
        (found - expected).array().abs() / expected.array().abs().max(1e-300);
    return relative.isFinite().all() ? relative.maxCoeff() : 1.0;
  };
  std::vector<Complex> s;
  std::vector<Eigen::MatrixXcd> from_inputs(probes), from_outputs(probes);
  for (std::size_t k = 0; k < probes; ++k) {
    s.push_back(point(fastest * std::pow(10.0, -static_cast<double>(k) / probes_per_decade)));
    static_cast<void>(evaluate_shifted(s[k], from_inputs[k]));
  }
  auto other = reaches(scaled.a.transpose(), scaled.c.transpose(), scaled.b.transpose());
  std::swap(reach_, other);
  start_ = Start::outputs;
  std::vector<std::size_t> different;
  for (std::size_t k = 0; k < probes; ++k) {
    static_cast<void>(evaluate_shifted(s[k], from_outputs[k]));
    if (error(from_inputs[k], from_outputs[k]) > sound) different.push_back(k);
  }
  // Where one is sound and the other is not; where neither is, below integrators, both are lost.
  constexpr std::size_t max_solves = 9;
  const std::size_t solves = std::min(max_solves, different.size());
  int for_outputs = 0;
  for (std::size_t i = 0; i < solves; ++i) {
    const std::size_t k = different[i * different.size() / solves];
    const Eigen::MatrixXcd solved =
        numerics::transfer_matrix(scaled.a, scaled.b, scaled.c, scaled.d, s[k]);
    for_outputs += static_cast<int>(error(from_outputs[k], solved) < sound) -
                   static_cast<int>(error(from_inputs[k], solved) < sound);
  }
  constexpr int majority = 2;
  if (for_outputs >= majority) return;
  std::swap(reach_, other);
  start_ = Start::inputs;
}

bool DenseResponse::evaluate(Complex s, Eigen::MatrixXcd& response) {
  if (!std::isfinite(s.real()) || !std::isfinite(s.imag())) {
    throw InvalidInput(
        fmt::format("DenseResponse: expected a finite s, found {} + {}j", s.real(), s.imag()));
  }
  return evaluate_shifted(sample_time_ > 0.0 ? s - 1.0 : s, response);
}

bool DenseResponse::evaluate_shifted(Complex s, Eigen::MatrixXcd& response) {
  response.resize(outputs(), inputs());
  const bool transposed = start_ == Start::outputs;
  bool regular = true;
  for (std::size_t k = 0; k < reach_.size(); ++k) {
    const Reach& reach = reach_[k];
    const auto first = static_cast<Eigen::Index>(k);
    Substitution<double> sums{};
    if (reach.order > 0) {
      HymanSubstitution::states(reach, s.real(), s.imag(), work_.data(), sums);
    }
    for (Eigen::Index second = 0; second < (transposed ? inputs() : outputs()); ++second) {
      const Eigen::Index row = transposed ? first : second, column = transposed ? second : first;
      Complex& element = response(row, column);
      element = feedthrough_(row, column);
      if (reach.order == 0) continue;
      HymanSubstitution::output(reach, second, work_.data(), sums);
      const Complex value = quotient(reach.order, reach.entry, {sums.output_re, sums.output_im},
                                     {sums.pivot_re, sums.pivot_im}, sums.size);
      if (std::isinf(value.real())) regular = false;
      element += value;
    }
  }
  return regular;
}

Eigen::MatrixXcd DenseResponse::at(Complex s) {
  Eigen::MatrixXcd response;
  if (!evaluate(s, response)) {
    throw NumericalFailure(fmt::format(
        "DenseResponse: {} = {} + {}j is a pole of the system to working precision; move off it",
        sample_time_ > 0.0 ? "z" : "s", s.real(), s.imag()));
  }
  return response;
}

// s, or z - 1 without cancellation.
Complex DenseResponse::point(double angular_frequency) const {
  if (!std::isfinite(angular_frequency)) {
    throw InvalidInput(fmt::format("DenseResponse: expected a finite angular frequency, found {}",
                                   angular_frequency));
  }
  if (sample_time_ == 0.0) return {0.0, angular_frequency};
  const double half = std::sin(0.5 * angular_frequency * sample_time_);
  return {-2.0 * half * half, std::sin(angular_frequency * sample_time_)};
}

const DenseResponse::Reach& DenseResponse::reach_of(Eigen::Index output, Eigen::Index input) const {
  if (output < 0 || output >= outputs() || input < 0 || input >= inputs()) {
    throw InvalidInput(fmt::format(
        "DenseResponse: expected an output below {} and an input below {}, found {} and {}",
        outputs(), inputs(), output, input));
  }
  return reach_[static_cast<std::size_t>(start_ == Start::outputs ? output : input)];
}

Complex DenseResponse::channel(double angular_frequency, Eigen::Index output, Eigen::Index input) {
  const Reach& reach = reach_of(output, input);
  const Complex s = point(angular_frequency);
  if (reach.order == 0) return feedthrough_(output, input);
  Substitution<double> sums{};
  HymanSubstitution::states(reach, s.real(), s.imag(), work_.data(), sums);
  HymanSubstitution::output(reach, start_ == Start::outputs ? input : output, work_.data(), sums);
  return feedthrough_(output, input) + quotient(reach.order, reach.entry,
                                                {sums.output_re, sums.output_im},
                                                {sums.pivot_re, sums.pivot_im}, sums.size);
}

void DenseResponse::evaluate(const Eigen::ArrayXd& angular_frequency, Eigen::ArrayXcd& response,
                             Eigen::Index output, Eigen::Index input) {
  const Reach& reach = reach_of(output, input);
  const Eigen::Index count = angular_frequency.size();
  response.resize(count);
  const double direct = feedthrough_(output, input);
  if (reach.order == 0) {
    response.setConstant(direct);
    return;
  }
  const Eigen::Index row = start_ == Start::outputs ? input : output;
  constexpr auto width = static_cast<std::size_t>(lane_count);
  std::array<double, 2 * width> s{};
  std::array<double, sizeof(Substitution<double>) / sizeof(double) * width> sums{};
  for (Eigen::Index first = 0; first < count; first += lane_count) {
    const Eigen::Index filled = std::min<Eigen::Index>(lane_count, count - first);
    for (std::size_t l = 0; l < width; ++l) {
      const auto offset = std::min(static_cast<Eigen::Index>(l), filled - 1);
      const Complex at = point(angular_frequency[first + offset]);
      s[l] = at.real();
      s[width + l] = at.imag();
    }
    numerics::run_on_widest_lanes<HymanSubstitution>(reach, s.data(), row, work_.data(),
                                                     sums.data());
    for (Eigen::Index l = 0; l < filled; ++l) {
      const double* sum = sums.data() + l;
      response[first + l] =
          direct + quotient(reach.order, reach.entry, {sum[3 * width], sum[4 * width]},
                            {sum[0], sum[width]}, sum[2 * width]);
    }
  }
}

}  // namespace boresight::plant
