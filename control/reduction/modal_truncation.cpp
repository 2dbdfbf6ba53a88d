#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/reduction/modal_truncation.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

// One mode as (m0 + m1 s + m2 s^2)/(d0 + d1 s + d2 s^2), real matrices over a real polynomial.
struct Fraction {
  std::array<MatrixXd, 3> numerator;
  std::array<double, 3> denominator{};
};

Fraction fraction_of(const plant::ModalForm& form, Index mode, bool without_static_gain) {
  const Complex pole = form.poles[mode];
  const MatrixXcd residue = form.output.col(mode) * form.input.row(mode);
  const MatrixXd none = MatrixXd::Zero(residue.rows(), residue.cols());
  Fraction result;
  if (pole.imag() > 0.0) {
    result.numerator = {-2.0 * (residue * std::conj(pole)).real(), 2.0 * residue.real(), none};
    result.denominator = {std::norm(pole), -2.0 * pole.real(), 1.0};
  } else {
    result.numerator = {residue.real(), none, none};
    result.denominator = {-pole.real(), 1.0, 0.0};
  }
  if (without_static_gain) {
    const double at = form.sample_time > 0.0 ? 1.0 : 0.0;
    const auto& [m0, m1, m2] = result.numerator;
    const auto& [d0, d1, d2] = result.denominator;
    const MatrixXd gain = (m0 + at * m1 + at * m2) / (d0 + at * d1 + at * d2);
    for (std::size_t k = 0; k < 3; ++k) {
      result.numerator[k] -= result.denominator[k] * gain;
    }
  }
  return result;
}

// Coefficients of |p|^2 on the axis as a polynomial of w^2, or on the unit circle of cos(angle),
// from the inner products of the coefficients of p.
std::array<double, 3> squared(const std::array<std::array<double, 3>, 3>& product, bool sampled) {
  if (!sampled) {
    return {product[0][0], product[1][1] - 2.0 * product[0][2], product[2][2]};
  }
  return {product[0][0] + product[1][1] + product[2][2] - 2.0 * product[0][2],
          2.0 * (product[0][1] + product[1][2]), 4.0 * product[0][2]};
}

// Frobenius norm at w (continuous) or at the angle w (sampled), by the factors of the denominator:
// nothing cancels next to a pole.
double gain_at(const Fraction& fraction, Complex pole, double w, bool sampled) {
  const Complex s = sampled ? std::polar(1.0, w) : Complex{0.0, w};
  const auto& [m0, m1, m2] = fraction.numerator;
  const MatrixXcd numerator =
      m0.cast<Complex>() + s * (m1.cast<Complex>() + s * m2.cast<Complex>());
  double denominator = std::abs(s - pole);
  if (pole.imag() > 0.0) denominator *= std::abs(s - std::conj(pole));
  return numerator.norm() / denominator;
}

// Largest Frobenius norm over all frequencies, from the stationary points of a ratio of two
// quadratic polynomials.
double peak_gain_of(const Fraction& fraction, Complex pole, bool sampled) {
  std::array<std::array<double, 3>, 3> above{};
  std::array<std::array<double, 3>, 3> below{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      above[i][j] = (fraction.numerator[i].array() * fraction.numerator[j].array()).sum();
      below[i][j] = fraction.denominator[i] * fraction.denominator[j];
    }
  }
  const auto [n0, n1, n2] = squared(above, sampled);
  const auto [q0, q1, q2] = squared(below, sampled);
  // (N/Q)' = 0: c0 + 2 c1 x + c2 x^2 = 0
  const double c0 = n1 * q0 - n0 * q1;
  const double c1 = n2 * q0 - n0 * q2;
  const double c2 = n2 * q1 - n1 * q2;
  double best = std::max(gain_at(fraction, pole, 0.0, sampled),
                         sampled ? gain_at(fraction, pole, std::acos(-1.0), true) : 0.0);
  if (!sampled) {
    // Towards infinite frequency.
    const bool pair = pole.imag() > 0.0;
    best = std::max(best,
                    fraction.numerator[pair ? 2 : 1].norm() / fraction.denominator[pair ? 2 : 1]);
  }
  const double discriminant = c1 * c1 - c0 * c2;
  if (!(discriminant >= 0.0)) return best;
  const double root = -c1 - std::copysign(std::sqrt(discriminant), c1);
  for (const double x : {root / c2, c0 / root}) {
    if (!std::isfinite(x)) continue;
    if (sampled ? std::abs(x) <= 1.0 : x >= 0.0) {
      best =
          std::max(best, gain_at(fraction, pole, sampled ? std::acos(x) : std::sqrt(x), sampled));
    }
  }
  return best;
}

bool stable(const plant::ModalForm& form, Complex pole) {
  return form.sample_time > 0.0 ? std::abs(pole) < 1.0 : pole.real() < 0.0;
}

struct Modes {
  plant::ModalForm form;
  std::vector<ModeContribution> contributions;
};

Modes modes_of(const plant::StateSpace& system, bool keep_static_gain) {
  Modes modes{plant::modal_form(system), {}};
  const plant::ModalForm& form = modes.form;
  if (!(form.condition <= plant::highest_modal_condition)) {
    throw NumericalFailure(fmt::format(
        "mode_contributions: expected independent eigenvectors, found them of condition "
        "{:.1e}; use truncate_balanced",
        form.condition));
  }
  for (Index i = 0; i < form.poles.size(); ++i) {
    const Complex pole = form.poles[i];
    ModeContribution mode{fmt::format("mode_{}", i + 1), pole,
                          std::numeric_limits<double>::infinity()};
    if (stable(form, pole)) {
      mode.peak_gain =
          peak_gain_of(fraction_of(form, i, keep_static_gain), pole, form.sample_time > 0.0);
    }
    modes.contributions.push_back(std::move(mode));
  }
  return modes;
}

std::vector<bool> named(const std::vector<ModeContribution>& modes,
                        const std::vector<std::string>& names) {
  std::vector<bool> result(modes.size(), false);
  for (const auto& name : names) {
    const auto found = std::find_if(modes.begin(), modes.end(),
                                    [&](const auto& mode) { return mode.name == name; });
    if (found == modes.end()) {
      throw InvalidInput(
          fmt::format("truncate_modes: expected one of the {} modes mode_1, ..., "
                      "found '{}'",
                      modes.size(), name));
    }
    result[static_cast<std::size_t>(found - modes.begin())] = true;
  }
  return result;
}

std::vector<bool> weakest(const std::vector<ModeContribution>& modes, double error_bound) {
  std::vector<std::size_t> order(modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return modes[a].peak_gain < modes[b].peak_gain;
  });
  std::vector<bool> result(modes.size(), false);
  double sum = 0.0;
  for (const std::size_t i : order) {
    sum += modes[i].peak_gain;
    if (!(sum <= error_bound)) break;
    result[i] = true;
  }
  return result;
}

// Appends the real form of one mode: with x the real and y the imaginary part of its coordinate,
// scaled so that input and output are of one size.
void append(plant::StateSpace& system, const plant::ModalForm& form, Index mode,
            const std::string& name) {
  const Complex pole = form.poles[mode];
  const Index at = system.a.rows();
  const Index width = pole.imag() > 0.0 ? 2 : 1;
  const double in = form.input.row(mode).norm();
  const double out = form.output.col(mode).norm();
  const double scale =
      in > 0.0 && out > 0.0 ? std::exp2(std::round(0.5 * std::log2(out / in))) : 1.0;
  const Eigen::RowVectorXcd input = form.input.row(mode) * scale;
  const Eigen::VectorXcd output = form.output.col(mode) / scale;
  system.a.conservativeResizeLike(MatrixXd::Zero(at + width, at + width));
  system.b.conservativeResizeLike(MatrixXd::Zero(at + width, system.b.cols()));
  system.c.conservativeResizeLike(MatrixXd::Zero(system.c.rows(), at + width));
  system.a.diagonal().tail(width).setConstant(pole.real());
  system.b.row(at) = input.real();
  system.c.col(at) = output.real() * static_cast<double>(width);
  if (width == 1) {
    system.states.push_back(name);
    return;
  }
  system.a(at, at + 1) = -pole.imag();
  system.a(at + 1, at) = pole.imag();
  system.b.row(at + 1) = input.imag();
  system.c.col(at + 1) = -2.0 * output.imag();
  system.states.push_back(name + ".1");
  system.states.push_back(name + ".2");
}

}  // namespace

std::vector<ModeContribution> mode_contributions(const plant::StateSpace& system,
                                                 bool keep_static_gain) {
  return modes_of(system, keep_static_gain).contributions;
}

ModalTruncation truncate_modes(const plant::StateSpace& system,
                               const ModalTruncationOptions& options) {
  if (options.dropped.empty() != options.error_bound.has_value()) {
    throw InvalidInput("truncate_modes: expected either modes to drop or an error bound");
  }
  if (options.error_bound && !(*options.error_bound >= 0.0)) {
    throw InvalidInput(fmt::format("truncate_modes: expected an error bound of 0 or more, found {}",
                                   *options.error_bound));
  }
  const Modes modes = modes_of(system, options.keep_static_gain);
  const std::vector<bool> drop = options.error_bound
                                     ? weakest(modes.contributions, *options.error_bound)
                                     : named(modes.contributions, options.dropped);
  ModalTruncation result;
  plant::StateSpace& reduced = result.system;
  const Index inputs = system.b.cols();
  const Index outputs = system.c.rows();
  reduced = {MatrixXd(0, 0),
             MatrixXd(0, inputs),
             MatrixXd(outputs, 0),
             system.d,
             system.inputs,
             system.outputs,
             {},
             system.sample_time};
  for (std::size_t i = 0; i < drop.size(); ++i) {
    const ModeContribution& mode = modes.contributions[i];
    const auto at = static_cast<Index>(i);
    if (!drop[i]) {
      append(reduced, modes.form, at, mode.name);
      continue;
    }
    if (!stable(modes.form, mode.pole)) {
      throw InvalidInput(
          fmt::format("truncate_modes: expected stable modes to drop, found {} at {} "
                      "+ {} j",
                      mode.name, mode.pole.real(), mode.pole.imag()));
    }
    result.dropped.push_back(mode);
    result.error_bound += mode.peak_gain;
    if (options.keep_static_gain) {
      const Fraction fraction = fraction_of(modes.form, at, false);
      const double s = system.sample_time > 0.0 ? 1.0 : 0.0;
      const auto& [m0, m1, m2] = fraction.numerator;
      const auto& [d0, d1, d2] = fraction.denominator;
      reduced.d += (m0 + s * m1) / (d0 + s * d1 + s * d2);
    }
  }
  return result;
}

}  // namespace boresight::control
