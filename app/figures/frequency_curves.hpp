#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// A complex response on a grid, by name.
struct NamedResponse {
  std::string name;
  Eigen::ArrayXcd values;
};

/// rad/s in Hz.
std::vector<double> in_hertz(const Eigen::ArrayXd& angular_frequency);
std::vector<double> numbers(const Eigen::ArrayXd& values);
/// 20 log10 |value|; NaN for 0.
std::vector<double> in_decibels(const Eigen::ArrayXcd& values);
/// Angles without jumps, the first within (-270, 90] degrees.
std::vector<double> in_degrees(const Eigen::ArrayXcd& values);

/// Axis of frequencies in Hz.
FigureAxis frequency_axis();

/// Panels of magnitude and phase over `angular_frequency` (rad/s); `magnitude` names the axis.
std::vector<FigurePanel> bode_panels(const Eigen::ArrayXd& angular_frequency,
                                     const std::vector<NamedResponse>& responses,
                                     const std::string& magnitude);

/// Two rising grids as one.
Eigen::ArrayXd merged(const Eigen::ArrayXd& first, const Eigen::ArrayXd& second);

}  // namespace boresight::app
