#include <fmt/format.h>

#include "accuracy_table.hpp"
#include <boresight/control/controllers/delay.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::reference {

namespace {

/// Ascending, 1 at s = 0.
std::vector<double> normalised(const nlohmann::json& descending) {
  auto coefficients = ascending(descending);
  const double first = coefficients.front();
  for (double& coefficient : coefficients) coefficient /= first;
  return coefficients;
}

std::complex<double> value_at(const std::vector<double>& polynomial, std::complex<double> s) {
  std::complex<double> sum = 0.0;
  for (auto i = polynomial.rbegin(); i != polynomial.rend(); ++i) sum = sum * s + *i;
  return sum;
}

}  // namespace

AccuracySection dead_time_accuracy() {
  AccuracySection section(
      "Dead times as rational functions",
      "`values/pade.json`: Pade approximants of exp(-s), from Vajta's table; coefficients with "
      "both "
      "polynomials 1 at s = 0, and the response of their realisation at 0.5, 3 and 20 rad/s.");
  const auto file = reference_values("pade");
  const double delay = file.at("T");
  for (const auto& row : file.at("rows")) {
    const int poles = row.at(0), zeros = row.at(1);
    const std::string name = fmt::format("[{}/{}]", zeros, poles);
    const auto numerator = normalised(row.at(3)), denominator = normalised(row.at(2));
    const auto found = control::pade_coefficients(delay, zeros, poles);
    section.numbers(name, "numerator", found.numerator, numerator, 16, 1e-9);
    section.numbers(name, "denominator", found.denominator, denominator, 16, 1e-9);
    plant::DenseResponse realised(control::pade_approximant(delay, zeros, poles, "u", "y"));
    std::vector<double> response, expected;
    for (const double w : {0.5, 3.0, 20.0}) {
      const std::complex<double> s(0.0, w);
      const auto gain = realised.channel(w),
                 exact = value_at(numerator, s) / value_at(denominator, s);
      response.insert(response.end(), {gain.real(), gain.imag()});
      expected.insert(expected.end(), {exact.real(), exact.imag()});
    }
    section.numbers(name, "response", response, expected, 16, 1e-9);
  }
  return section;
}

}  // namespace boresight::reference
