#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;

// Real roots, and of each pair the one above the real axis.
struct RootSet {
  Roots real;
  Roots upper;
};

RootSet split(const char* what, const std::string& name, const Roots& roots) {
  RootSet set;
  Roots lower;
  for (const Complex root : roots) {
    if (!std::isfinite(root.real()) || !std::isfinite(root.imag())) {
      throw InvalidInput(fmt::format("zeros_poles_gain '{}': a {} is not finite", name, what));
    }
    (root.imag() == 0.0 ? set.real : root.imag() > 0.0 ? set.upper : lower).push_back(root);
  }
  const auto refuse = [&](Complex root) {
    throw InvalidInput(
        fmt::format("zeros_poles_gain '{}': the complex {} {:.17g} {:+.17g}j has no conjugate "
                    "among the others",
                    name, what, root.real(), root.imag()));
  };
  for (Complex& root : set.upper) {
    const auto mate = std::min_element(lower.begin(), lower.end(), [&](Complex a, Complex b) {
      return std::abs(a - std::conj(root)) < std::abs(b - std::conj(root));
    });
    if (mate == lower.end() || std::abs(*mate - std::conj(root)) > 1e-10 * std::abs(root)) {
      refuse(root);
    }
    root = 0.5 * (root + std::conj(*mate));
    lower.erase(mate);
  }
  if (!lower.empty()) refuse(lower.front());
  return set;
}

struct Section {
  Roots poles;  // one real, two real, or a pair
  Roots zeros;  // at most as many
};

// Where a root lies in the s-plane, 0 excepted.
Complex place(Complex root, double sample_time) {
  constexpr double minimum = 1e-300;
  if (sample_time == 0.0) return root == 0.0 ? Complex(minimum) : root;
  const Complex logarithm = std::log(std::abs(root) < minimum ? Complex(minimum) : root);
  return logarithm == 0.0 ? Complex(minimum) : logarithm;
}

// How badly a zero and a pole go together: decades apart first, then direction.
double distance(Complex zero, Complex pole, double sample_time) {
  const Complex z = place(zero, sample_time), p = place(pole, sample_time);
  return std::abs(std::log(std::abs(z) / std::abs(p))) +
         std::abs(z - p) / (std::abs(z) + std::abs(p));
}

class Pairing {
 public:
  Pairing(const RootSet& zeros, const RootSet& poles, double sample_time)
      : sample_time_(sample_time), single_(poles.real) {
    for (const Complex pole : poles.upper) sections_.push_back({{pole, std::conj(pole)}, {}});
    for (const Complex zero : zeros.upper) place_pair(zero);
    for (const Complex pole : single_) sections_.push_back({{pole}, {}});
    for (const Complex zero : zeros.real) place_real(zero);
    std::stable_sort(sections_.begin(), sections_.end(),
                     [this](const Section& a, const Section& b) {
                       return std::abs(place(a.poles.front(), sample_time_)) <
                              std::abs(place(b.poles.front(), sample_time_));
                     });
  }
  const std::vector<Section>& sections() const { return sections_; }

 private:
  // With a pair of poles that has no zeros yet, or with two real poles.
  void place_pair(Complex zero) {
    Section* best = nullptr;
    double minimum = std::numeric_limits<double>::infinity();
    for (auto& section : sections_) {
      if (!section.zeros.empty()) continue;
      const double apart = distance(zero, section.poles.front(), sample_time_);
      if (apart < minimum) std::tie(best, minimum) = std::pair(&section, apart);
    }
    std::sort(single_.begin(), single_.end(), [&](Complex a, Complex b) {
      return distance(zero, a, sample_time_) > distance(zero, b, sample_time_);
    });
    if (const std::size_t n = single_.size(); n >= 2) {
      const double apart = 0.5 * (distance(zero, single_[n - 1], sample_time_) +
                                  distance(zero, single_[n - 2], sample_time_));
      if (apart < minimum) {
        sections_.push_back({{single_[n - 2], single_[n - 1]}, {}});
        single_.resize(n - 2);
        best = &sections_.back();
      }
    }
    best->zeros = {zero, std::conj(zero)};
  }

  void place_real(Complex zero) {
    Section* best = nullptr;
    double minimum = std::numeric_limits<double>::infinity();
    for (auto& section : sections_) {
      if (section.zeros.size() == section.poles.size()) continue;
      const double apart = distance(zero, section.poles.front(), sample_time_);
      if (apart < minimum) std::tie(best, minimum) = std::pair(&section, apart);
    }
    best->zeros.push_back(zero);
  }

  double sample_time_;
  Roots single_;
  std::vector<Section> sections_;
};

struct Realisation {
  Eigen::MatrixXd a, b, c;
  double d = 0.0;
};

Realisation realise(const Section& section) {
  if (section.poles.size() == 1) {
    const double pole = section.poles.front().real();
    const bool zero = !section.zeros.empty();
    return {Eigen::MatrixXd::Constant(1, 1, pole), Eigen::MatrixXd::Ones(1, 1),
            Eigen::MatrixXd::Constant(1, 1, zero ? pole - section.zeros.front().real() : 1.0),
            zero ? 1.0 : 0.0};
  }
  // (slope s + level)/((s - p)(s - q)), the quotient taken off
  const Complex p = section.poles[0], q = section.poles[1];
  double slope = 0.0, level = 1.0;
  if (section.zeros.size() == 1) {
    slope = 1.0;
    level = -section.zeros.front().real();
  } else if (section.zeros.size() == 2) {
    slope = (p + q - section.zeros[0] - section.zeros[1]).real();
    level = (section.zeros[0] * section.zeros[1] - p * q).real();
  }
  double size = std::max(std::abs(p), std::abs(q));
  if (size == 0.0) size = 1.0;
  Realisation result{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 1), Eigen::MatrixXd(1, 2),
                     section.zeros.size() == 2 ? 1.0 : 0.0};
  result.b << 0.0, 1.0;
  if (p.imag() == 0.0) {
    result.a << p.real(), size, 0.0, q.real();
    result.c << (level + slope * p.real()) / size, slope;
  } else {
    result.a << 0.0, size, -size, 2.0 * p.real();
    result.c << level / size, slope;
  }
  return result;
}

// Power of two near the gain of a section at its own frequency, or near `usual` if it has none.
int gain_exponent(const Section& section, double usual, double sample_time) {
  double frequency = std::abs(place(section.poles.front(), sample_time));
  if (!(frequency > 1e-200)) frequency = usual;
  if (sample_time > 0.0) frequency = std::min(frequency, 3.0);
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Complex s = sample_time > 0.0 ? std::polar(1.0, frequency) : Complex(0.0, frequency);
    double gain = 1.0;
    for (const Complex zero : section.zeros) gain *= std::abs(s - zero);
    for (const Complex pole : section.poles) gain /= std::abs(s - pole);
    if (gain > 0.0 && std::isfinite(gain)) return static_cast<int>(std::lround(std::log2(gain)));
    frequency *= 0.9;  // a zero or a pole lies just there
  }
  return 0;
}

}  // namespace

StateSpace zeros_poles_gain(const Roots& zeros, const Roots& poles, double gain,
                            const std::string& input, const std::string& output,
                            const std::string& name, double sample_time) {
  if (zeros.size() > poles.size()) {
    throw InvalidInput(
        fmt::format("zeros_poles_gain '{}': expected no more zeros than poles (a proper function), "
                    "found {} and {}",
                    name, zeros.size(), poles.size()));
  }
  if (!std::isfinite(gain)) {
    throw InvalidInput(fmt::format("zeros_poles_gain '{}': the gain is not finite", name));
  }
  const Pairing pairing(split("zero", name, zeros), split("pole", name, poles), sample_time);
  double sum = 0.0, count = 0.0;
  for (const Complex pole : poles) {
    const double size = std::abs(place(pole, sample_time));
    if (!(size > 1e-200)) continue;
    sum += std::log(size);
    count += 1.0;
  }
  const double usual = count > 0.0 ? std::exp(sum / count) : 1.0;

  const auto n = static_cast<Eigen::Index>(poles.size());
  StateSpace system{Eigen::MatrixXd::Zero(n, n),
                    Eigen::MatrixXd::Zero(n, 1),
                    Eigen::MatrixXd::Zero(1, n),
                    Eigen::MatrixXd::Ones(1, 1),
                    {input},
                    {output},
                    {},
                    sample_time};
  int exponent = 0;
  Eigen::Index done = 0;
  for (const Section& section : pairing.sections()) {
    Realisation next = realise(section);
    const int own = gain_exponent(section, usual, sample_time);
    exponent += own;
    next.c *= std::ldexp(1.0, -own);
    next.d *= std::ldexp(1.0, -own);
    const Eigen::Index order = next.a.rows();
    system.a.block(done, done, order, order) = next.a;
    system.a.block(done, 0, order, done) = next.b * system.c.leftCols(done);
    system.b.middleRows(done, order) = next.b * system.d;
    system.c.leftCols(done) *= next.d;
    system.c.middleCols(done, order) = next.c;
    system.d *= next.d;
    done += order;
  }
  // The gain half at the input, half at the output.
  const int half = exponent / 2;
  system.b *= std::ldexp(1.0, half);
  system.c *= std::ldexp(gain, exponent - half);
  system.d *= std::ldexp(gain, exponent - half);
  system.d *= std::ldexp(1.0, half);
  for (Eigen::Index i = 0; i < n; ++i) system.states.push_back(fmt::format("{}.{}", name, i + 1));
  validate(system);
  return system;
}

}  // namespace boresight::plant
