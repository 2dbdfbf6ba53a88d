#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/program/digital_sections.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::control::program {
namespace {

// Coefficients of 1, 1/z, 1/z^2 of a polynomial in s = k (z - 1)/(z + 1), times ((z + 1)/z)^order.
std::array<double, 3> in_delays(const std::vector<double>& polynomial, int order, double k) {
  const auto coefficient = [&](std::size_t i) {
    return i < polynomial.size() ? polynomial[i] : 0.0;
  };
  const double c0 = coefficient(0), c1 = coefficient(1) * k, c2 = coefficient(2) * k * k;
  if (order == 0) return {c0, 0.0, 0.0};
  if (order == 1) return {c0 + c1, c0 - c1, 0.0};
  return {c0 + c1 + c2, 2.0 * (c0 - c2), c0 - c1 + c2};
}

std::string unique_name(const std::string& wanted, const std::vector<DigitalSection>& others) {
  int number = 1;
  std::string name = wanted;
  for (const auto& other : others) {
    if (other.name == name) name = fmt::format("{}_{}", wanted, ++number);
  }
  return name;
}

// States one by one or in consecutive pairs, which only their own block couples.
bool is_in_blocks(const Eigen::MatrixXd& a) {
  Eigen::Index at = 0;
  while (at < a.rows()) {
    const bool pair = at + 1 < a.rows() && (a(at, at + 1) != 0.0 || a(at + 1, at) != 0.0);
    const Eigen::Index size = pair ? 2 : 1;
    const Eigen::Index rest = a.rows() - at - size;
    if (!a.block(at, at + size, size, rest).isZero(0.0) ||
        !a.block(at + size, at, rest, size).isZero(0.0)) {
      return false;
    }
    at += size;
  }
  return true;
}

std::string state_name(std::complex<double> pole, double sample_time, Eigen::Index number) {
  const double frequency = std::abs(std::log(pole)) / (2.0 * std::numbers::pi * sample_time);
  return fmt::format("mode {} at {:.3g} Hz", number, frequency);
}

}  // namespace

std::vector<DigitalSection> digital_sections(const Controller& controller, LoopPath path,
                                             double sample_time) {
  const Controller warped = prewarped(controller, sample_time);
  const double k = 2.0 / sample_time;
  const std::string path_name(to_string(path));
  std::vector<DigitalSection> sections;
  for (const PathSection& factor : path_sections(warped, path)) {
    DigitalSection section;
    section.order = static_cast<int>(factor.denominator.size()) - 1;
    section.name = unique_name(fmt::format("{}_{}", path_name, to_string(factor.kind)), sections);
    section.description =
        fmt::format("{} {} ({})", path_name, to_string(factor.kind), factor.symbol);
    const auto numerator = in_delays(factor.numerator, section.order, k);
    const auto denominator = in_delays(factor.denominator, section.order, k);
    for (std::size_t i = 0; i < 3; ++i) section.b[i] = numerator[i] / denominator[0];
    for (std::size_t i = 0; i < 2; ++i) section.a[i] = denominator[i + 1] / denominator[0];
    section.static_gain = factor.numerator.front() / factor.denominator.front();
    section.inverse_static_gain = factor.denominator.front() / factor.numerator.front();
    if ((path == LoopPath::rate || path == LoopPath::position) &&
        !std::isfinite(section.inverse_static_gain)) {
      throw InvalidInput(fmt::format(
          "controller program: expected a static gain above 0 of each part of the rate and "
          "position path, found none of the {}",
          section.description));
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

plant::StateSpace in_modal_blocks(const plant::StateSpace& controller) {
  if (controller.outputs.size() != 1) {
    throw InvalidInput(fmt::format("controller program: expected one output, found {}",
                                   controller.outputs.size()));
  }
  if (is_in_blocks(controller.a)) return controller;
  plant::ModalForm form;
  try {
    form = plant::modal_form(controller);
  } catch (const NumericalFailure&) {
    return controller;
  }
  if (!(form.condition < plant::highest_modal_condition)) return controller;
  plant::StateSpace blocks = controller;
  blocks.a.setZero();
  blocks.c.setZero();
  Eigen::Index at = 0, number = 0;
  for (Eigen::Index i = 0; i < form.poles.size(); ++i) {
    const std::complex<double> pole = form.poles[i] + form.pole_correction[i];
    const Eigen::RowVectorXcd input = form.output(0, i) * form.input.row(i);
    const std::string name = state_name(pole, controller.sample_time, ++number);
    blocks.a(at, at) = pole.real();
    blocks.c(0, at) = 1.0;
    blocks.states[static_cast<std::size_t>(at)] = name;
    if (!(form.poles[i].imag() > 0.0)) {
      blocks.b.row(at++) = input.real();
      continue;
    }
    blocks.a(at, at + 1) = -pole.imag();
    blocks.a(at + 1, at) = pole.imag();
    blocks.a(at + 1, at + 1) = pole.real();
    blocks.b.row(at) = 2.0 * input.real();
    blocks.b.row(at + 1) = 2.0 * input.imag();
    blocks.states[static_cast<std::size_t>(at + 1)] = name + ", quadrature";
    at += 2;
  }
  return blocks;
}

}  // namespace boresight::control::program
