#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/state_space_enclosure.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Least |j w - pole| on the interval (direct ones).
double distance(Complex pole, const numerics::FrequencyInterval& interval) {
  const double beside =
      std::max(0.0, std::abs(interval.centre - pole.imag()) - interval.half_width);
  return std::hypot(pole.real(), beside);
}

// 1/(j a - pole b), as resonance_inverse for one real pole.
numerics::TaylorModel lag_inverse(double decay, const numerics::FrequencyInterval& interval) {
  const double c = interval.centre;
  if (interval.reciprocal)
    return numerics::inverse({{decay * c, 1.0}, decay, 0.0, 0.0}, interval.half_width);
  return numerics::inverse({{decay, c}, {0.0, 1.0}, 0.0, 0.0}, interval.half_width,
                           distance(-decay, interval));
}

}  // namespace

numerics::TaylorModel resonance_inverse(double w0, double decay,
                                        const numerics::FrequencyInterval& interval) {
  const double c = interval.centre;
  if (interval.reciprocal) {
    const double stiffness = w0 * w0 + decay * decay;
    return numerics::inverse({{stiffness * c * c - 1.0, 2.0 * decay * c},
                              {2.0 * stiffness * c, 2.0 * decay},
                              stiffness,
                              0.0},
                             interval.half_width);
  }
  const double minimum = distance({-decay, w0}, interval) * distance({-decay, -w0}, interval);
  return numerics::inverse(
      {{(w0 - c) * (w0 + c) + decay * decay, 2.0 * decay * c}, {-2.0 * c, 2.0 * decay}, -1.0, 0.0},
      interval.half_width, minimum);
}

StateSpaceEnclosure::StateSpaceEnclosure(const StateSpace& system) : system_(balanced(system)) {
  if (system.sample_time != 0.0) {
    throw InvalidInput(fmt::format(
        "StateSpaceEnclosure: expected a continuous system, found one sampled every {} s",
        system.sample_time));
  }
  try {
    form_ = modal_form(system_);
  } catch (const NumericalFailure&) {
    return;
  }
  if (form_->condition > highest_modal_condition) {
    form_.reset();
    return;
  }
  for (Eigen::Index k = 0; k < form_->poles.size(); ++k) {
    Section section{form_->poles[k] + form_->pole_correction[k], form_->pole_error[k], {}, {}, {}};
    const bool pair = section.pole.imag() > 0.0;
    for (Eigen::Index r = 0; r < rows(); ++r) {
      for (Eigen::Index c = 0; c < columns(); ++c) {
        const Complex residue = form_->output(r, k) * form_->input(k, c);
        section.level.push_back(pair ? -2.0 * (residue * std::conj(section.pole)).real()
                                     : residue.real());
        section.slope.push_back(pair ? 2.0 * residue.real() : 0.0);
        section.uncertainty.push_back(8.0 * epsilon * form_->output.row(r).cwiseAbs().maxCoeff() *
                                      form_->input.col(c).cwiseAbs().maxCoeff());
      }
    }
    sections_.push_back(std::move(section));
  }
}

void StateSpaceEnclosure::enclose(const numerics::FrequencyInterval& interval,
                                  std::vector<numerics::TaylorModel>& elements) const {
  elements.resize(static_cast<std::size_t>(rows() * columns()));
  if (by_modes()) {
    by_sections(interval, elements);
  } else {
    by_resolvent(interval, elements);
  }
}

void StateSpaceEnclosure::by_sections(const numerics::FrequencyInterval& interval,
                                      std::vector<numerics::TaylorModel>& elements) const {
  const double c = interval.centre, h = interval.half_width;
  std::size_t e = 0;
  for (Eigen::Index i = 0; i < rows(); ++i) {
    for (Eigen::Index j = 0; j < columns(); ++j) {
      elements[e++] = numerics::TaylorModel::constant(system_.d(i, j));
    }
  }
  for (const Section& section : sections_) {
    const bool pair = section.pole.imag() > 0.0;
    const double decay = -section.pole.real();
    const numerics::TaylorModel inverse =
        pair ? resonance_inverse(section.pole.imag(), decay, interval)
             : lag_inverse(decay, interval);
    // The numerators: level b^2 + slope j a b for a pair, level b for a real pole.
    numerics::TaylorModel level = inverse, slope{};
    if (interval.reciprocal) {
      const numerics::TaylorModel b{c, 1.0, 0.0, 0.0};
      level = product(level, b, h);
      if (pair) {
        slope = product(level, numerics::TaylorModel::constant({0.0, 1.0}), h);
        level = product(level, b, h);
      }
    } else if (pair) {
      slope = product(inverse, {{0.0, c}, {0.0, 1.0}, 0.0, 0.0}, h);
    }
    // What rounding of the pole, the residue and the sums may add. Near its own pole an element is
    // inversely proportional to the distance, so the pole's error counts relative to that.
    double minimum =
        interval.reciprocal ? std::abs(section.pole) : distance(section.pole, interval);
    if (interval.reciprocal) {
      const double lowest = 1.0 / (c + h);
      minimum = std::hypot(decay, std::max(0.0, lowest - section.pole.imag()));
    }
    const double level_size = magnitude_bound(level, h) + level.rest;
    const double slope_size = magnitude_bound(slope, h) + slope.rest;
    const double relative = 4.0 * epsilon + 2.0 * section.pole_error / minimum;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const double l = section.level[k], s = section.slope[k];
      numerics::TaylorModel& element = elements[k];
      element.value += l * level.value + s * slope.value;
      element.slope += l * level.slope + s * slope.slope;
      element.curvature += l * level.curvature + s * slope.curvature;
      element.rest += std::abs(l) * level.rest + std::abs(s) * slope.rest;
      element.rest += relative * (std::abs(l) * level_size + std::abs(s) * slope_size) +
                      section.uncertainty[k] * (pair ? slope_size : level_size);
    }
  }
}

void StateSpaceEnclosure::by_resolvent(const numerics::FrequencyInterval& interval,
                                       std::vector<numerics::TaylorModel>& elements) const {
  const double c = interval.centre, h = interval.half_width;
  const Eigen::Index n = system_.a.rows();
  // M(x) = base + x turn, H = D + C b M^-1 B with b = 1 or centre + x.
  Eigen::MatrixXcd base, turn;
  if (interval.reciprocal) {
    base = -c * system_.a.cast<Complex>();
    base.diagonal().array() += Complex(0.0, 1.0);
    turn = -system_.a.cast<Complex>();
  } else {
    base = -system_.a.cast<Complex>();
    base.diagonal().array() += Complex(0.0, c);
    turn = Complex(0.0, 1.0) * Eigen::MatrixXcd::Identity(n, n);
  }
  Eigen::MatrixXcd right(n, n + columns());
  right << turn, system_.b.cast<Complex>();
  const Eigen::MatrixXcd solved = numerics::complex_solve(base, right);
  const Eigen::MatrixXcd step = -solved.leftCols(n);
  const Eigen::MatrixXcd x0 = solved.rightCols(columns());
  const Eigen::MatrixXcd x1 = step * x0, x2 = step * x1, x3 = step * x2;
  const double turn_size = step.norm();
  const double margin = 1.0 - h * turn_size;
  const bool known = solved.allFinite() && margin > 0.0;
  std::size_t e = 0;
  for (Eigen::Index i = 0; i < rows(); ++i) {
    const auto row = system_.c.row(i).cast<Complex>();
    for (Eigen::Index j = 0; j < columns(); ++j, ++e) {
      if (!known) {
        elements[e] = {0.0, 0.0, 0.0, infinity};
        continue;
      }
      numerics::TaylorModel element{(row * x0.col(j))(0), (row * x1.col(j))(0),
                                    (row * x2.col(j))(0),
                                    row.norm() * x3.col(j).norm() * h * h * h / margin};
      // Solving leaves errors in proportion to the condition of the solve.
      element.rest += 8.0 * epsilon * static_cast<double>(n) * row.norm() * x0.col(j).norm() *
                      (1.0 + base.norm() * turn_size / turn.norm());
      if (interval.reciprocal) element = product(element, {c, 1.0, 0.0, 0.0}, h);
      elements[e] = element + numerics::TaylorModel::constant(system_.d(i, j));
    }
  }
}

}  // namespace boresight::plant
