#include <algorithm>

#include "accuracy_table.hpp"
#include <boresight/control/analysis/transmission_zeros.hpp>

namespace boresight::reference {

namespace {

/// Real and imaginary parts of `found` in the order of the nearest of `reference`.
Eigen::MatrixXd in_order_of(const std::vector<std::complex<double>>& reference,
                            const Eigen::VectorXcd& found) {
  std::vector<std::complex<double>> left(found.begin(), found.end());
  Eigen::MatrixXd result(found.size(), 2);
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const auto target = reference.at(static_cast<std::size_t>(i));
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](const auto& one, const auto& other) {
          return std::abs(one - target) < std::abs(other - target);
        });
    result.row(i) << nearest->real(), nearest->imag();
    left.erase(nearest);
  }
  return result;
}

}  // namespace

AccuracySection zero_accuracy() {
  AccuracySection section(
      "Transmission zeros",
      "`values/transmission_zeros.json`: the examples of Emami-Naeini and Van Dooren (1982) and "
      "two systems without finite zeros for which other programs invented some. A double zero is "
      "known to half the digits.");
  const auto file = reference_values("transmission_zeros");
  for (const auto& entry : file.at("cases")) {
    const std::string name = entry.at("id");
    const auto zeros = control::transmission_zeros(system_of(entry));
    const auto reference = complex_numbers(entry.at("zeros"));
    if (reference.empty() || zeros.size() != static_cast<Eigen::Index>(reference.size())) {
      section.stated(name, "finite zeros", reference.empty() ? "none" : "as many",
                     zeros.size() == static_cast<Eigen::Index>(reference.size()));
      continue;
    }
    Eigen::MatrixXd expected(zeros.size(), 2);
    for (Eigen::Index i = 0; i < zeros.size(); ++i) {
      const auto zero = reference[static_cast<std::size_t>(i)];
      expected.row(i) << zero.real(), zero.imag();
    }
    const bool twice = name == "ex8";
    section.matrix(name, twice ? "double zero" : "zeros (real, imaginary)",
                   in_order_of(reference, zeros), expected, 16, twice ? 1e-7 : 1e-9);
  }
  return section;
}

}  // namespace boresight::reference
