#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <boresight/app/figures/frequency_curves.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {

std::vector<double> numbers(const Eigen::ArrayXd& values) {
  return {values.begin(), values.end()};
}

std::vector<double> in_hertz(const Eigen::ArrayXd& angular_frequency) {
  return numbers(angular_frequency / two_pi);
}

std::vector<double> in_decibels(const Eigen::ArrayXcd& values) {
  std::vector<double> decibels;
  decibels.reserve(static_cast<std::size_t>(values.size()));
  for (const auto& value : values) {
    const double magnitude = std::abs(value);
    decibels.push_back(magnitude > 0.0 ? 20.0 * std::log10(magnitude)
                                       : std::numeric_limits<double>::quiet_NaN());
  }
  return decibels;
}

std::vector<double> in_degrees(const Eigen::ArrayXcd& values) {
  std::vector<double> degrees;
  degrees.reserve(static_cast<std::size_t>(values.size()));
  for (const auto& value : values) {
    double angle = std::arg(value) * 180.0 / std::numbers::pi;
    if (degrees.empty()) {
      if (angle > 90.0) angle -= 360.0;
    } else {
      angle -= 360.0 * std::round((angle - degrees.back()) / 360.0);
    }
    degrees.push_back(angle);
  }
  return degrees;
}

FigureAxis frequency_axis() {
  return {.label = "frequency", .unit = "Hz", .scale = AxisScale::logarithmic};
}

std::vector<FigurePanel> bode_panels(const Eigen::ArrayXd& angular_frequency,
                                     const std::vector<NamedResponse>& responses,
                                     const std::string& magnitude) {
  std::vector<FigurePanel> panels(2);
  panels[0].y = {.label = magnitude, .unit = "dB"};
  panels[1].y = {.label = "phase", .unit = "deg"};
  const std::vector<double> hertz = in_hertz(angular_frequency);
  for (const auto& [name, values] : responses) {
    panels[0].series.push_back({.name = name, .x = hertz, .y = in_decibels(values)});
    panels[1].series.push_back({.name = name, .x = hertz, .y = in_degrees(values)});
  }
  return panels;
}

Eigen::ArrayXd merged(const Eigen::ArrayXd& first, const Eigen::ArrayXd& second) {
  std::vector<double> all;
  std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(all));
  return Eigen::Map<const Eigen::ArrayXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace boresight::app
