#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

/// One or two roots of a real polynomial that stand together.
struct RootGroup {
  std::vector<double> polynomial;  // ascending, leading coefficient 1
  double magnitude = 0.0;          // geometric mean of the roots'
};

/// Conjugate pairs, and real roots two by two in order of magnitude.
inline std::vector<RootGroup> root_groups(std::vector<std::complex<double>> roots) {
  std::vector<RootGroup> groups;
  std::vector<double> real;
  for (const auto root : roots) {
    if (root.imag() == 0.0) real.push_back(root.real());
    if (root.imag() > 0.0) {
      groups.push_back({{std::norm(root), -2.0 * root.real(), 1.0}, std::abs(root)});
    }
  }
  std::sort(real.begin(), real.end(), [](double a, double b) { return std::abs(a) > std::abs(b); });
  for (std::size_t i = 0; i + 1 < real.size(); i += 2) {
    groups.push_back({{real[i] * real[i + 1], -real[i] - real[i + 1], 1.0},
                      std::sqrt(std::abs(real[i] * real[i + 1]))});
  }
  if (real.size() % 2 == 1) groups.push_back({{-real.back(), 1.0}, std::abs(real.back())});
  return groups;
}

/// gain * prod(s - zeros)/prod(s - poles) (z in place of s where sampled) as a cascade of sections
/// of at most two poles with the zeros of the nearest magnitude: no polynomial of the whole is
/// formed. Input u, output y.
inline plant::StateSpace zeros_poles_gain(const std::vector<std::complex<double>>& zeros,
                                          const std::vector<std::complex<double>>& poles,
                                          double gain, double sample_time) {
  auto numerators = root_groups(zeros);
  const auto denominators = root_groups(poles);
  if (poles.empty() || zeros.size() > poles.size()) {
    throw std::runtime_error("zeros_poles_gain: no poles, or more zeros than poles");
  }
  // Groups of two zeros choose first, so that a single pole is left for a single zero.
  std::sort(numerators.begin(), numerators.end(), [](const RootGroup& a, const RootGroup& b) {
    return a.polynomial.size() > b.polynomial.size();
  });
  std::vector<std::vector<double>> numerator_of(denominators.size());
  for (const auto& group : numerators) {
    std::size_t nearest = denominators.size();
    double distance = HUGE_VAL;
    for (std::size_t i = 0; i < denominators.size(); ++i) {
      const bool fits =
          numerator_of[i].empty() && denominators[i].polynomial.size() >= group.polynomial.size();
      const double d =
          std::abs(std::log((group.magnitude + 1e-300) / (denominators[i].magnitude + 1e-300)));
      if (fits && d < distance) {
        nearest = i;
        distance = d;
      }
    }
    numerator_of.at(nearest) = group.polynomial;
  }
  std::vector<plant::StateSpace> sections;
  for (std::size_t i = 0; i < denominators.size(); ++i) {
    auto numerator = numerator_of[i].empty() ? std::vector{1.0} : numerator_of[i];
    if (i == 0) {
      for (double& coefficient : numerator) coefficient *= gain;
    }
    const std::string input = i == 0 ? "u" : "link" + std::to_string(i);
    const std::string output = i + 1 == denominators.size() ? "y" : "link" + std::to_string(i + 1);
    sections.push_back(plant::rational(numerator, denominators[i].polynomial, input, output,
                                       "section" + std::to_string(i + 1)));
    sections.back().sample_time = sample_time;
  }
  return plant::connect(sections, {"u"}, {"y"});
}

}  // namespace boresight::reference
