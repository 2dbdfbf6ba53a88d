#pragma once

#include <cmath>
#include <complex>

#include "design/reference_problem.hpp"
#include <boresight/design/limits/loop_figures.hpp>
#include <boresight/design/limits/lqg_search.hpp>

namespace boresight::reference {

struct Loop {
  Eigen::ArrayXd frequency = [] {
    const Eigen::ArrayXd grid = plant::frequency_grid(antenna(), 1e-3, 24.9, 200);
    Eigen::ArrayXd with_slow(grid.size() + 60);
    with_slow
        << Eigen::ArrayXd::LinSpaced(60, std::log(1e-3 * grid[0]), std::log(0.95 * grid[0])).exp(),
        grid;
    return with_slow;
  }();
  design::SampledSetting setting = [this] {
    design::TrackingProblem problem = tracking_problem();
    problem.noise.torque_rms = 0.5;
    return design::SampledSetting("own", problem.plant, design::fit_wind_filter(problem),
                                  problem.noise, 0.02, frequency);
  }();
  plant::StateSpace controller = design::weighted_lqg(
      setting, {.command_weight = 0.01, .spring_weight = 1.0, .friction_torque = 20.0});
  Eigen::ArrayXXcd response = design::SampledSetting::controller_response(controller, frequency);
  design::SampledSpectrum spectrum = design::sampled_spectrum(setting, frequency);

  design::LoopFigures figures(const Eigen::ArrayXXcd& changed) const {
    return design::LoopFigureEvaluator(spectrum).figures(design::packed_response(changed));
  }
  design::PeakFigure locked_motor_gain(const Eigen::ArrayXXcd& changed) const {
    return design::LoopFigureEvaluator(spectrum).locked_motor_gain(
        design::packed_response(changed));
  }
};

// Change of the figure's logarithm by a small change of the controller's response.
inline double slope_along(const design::RmsFigure& figure, const Eigen::ArrayXXcd& change) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < change.rows(); ++k) {
    const auto place = static_cast<std::size_t>(k);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& gradient = figure.gradient[place / numerics::pack_size].at(i);
      const std::size_t lane = place % numerics::pack_size;
      sum += (std::complex<double>(gradient.re[lane], gradient.im[lane]) *
              change(k, static_cast<Eigen::Index>(i)))
                 .real();
    }
  }
  return 2.0 * sum;
}
inline double slope_along(const design::PeakFigure& figure, const Eigen::ArrayXXcd& change) {
  double sum = 0.0;
  for (const design::PeakFigure::Point& point : figure.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum += (point.gradient.at(i) * change(point.frequency, static_cast<Eigen::Index>(i))).real();
    }
  }
  return 2.0 * sum;
}

}  // namespace boresight::reference
