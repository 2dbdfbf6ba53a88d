#pragma once

#include <Eigen/Core>

#include <boresight/design/limits/sampled_setting.hpp>

namespace boresight::design {

/// What the figures of a loop on one plant need at each frequency (LoopFigureEvaluator). Figures
/// and their gradients with respect to the controller's response then take some 300 operations
/// a frequency, whatever the orders of plant and controller. The exact sampled loop, as in
/// SampledSetting. Sensors: tachometer, encoder, motor torque.
struct SampledSpectrum {
  Eigen::ArrayXXcd response;      // frequencies x sensors: of the command
  Eigen::ArrayXXcd sensors;       // x 9, by rows: density of the sensors without the loop
  Eigen::ArrayXXcd cross;         // x sensors: of sensor and boresight, by way of the command
  Eigen::ArrayXd boresight;       // density of the boresight without the loop, rad^2
  Eigen::ArrayXd by_command;      // of the boresight, per density of the command
  Eigen::ArrayXd noise;           // of the sensors
  double unavoidable_cost = 0.0;  // rad^2, what no command changes
  Eigen::ArrayXd weights;         // of a sum over the frequencies that is a mean square
};

/// `frequency`: rad/s, rising, from above 0 to below the Nyquist frequency; the trapezoidal rule
/// must resolve the loop's resonances. O(states^3) once and O(states^3) a frequency.
SampledSpectrum sampled_spectrum(const SampledSetting& setting, const Eigen::ArrayXd& frequency);

/// S = 1/(1 - K P) at the valve command, K the controller's response. Here and below `controller`
/// is SampledSetting::controller_response at the spectrum's frequencies.
Eigen::ArrayXcd sensitivity_function(const SampledSpectrum& spectrum,
                                     const Eigen::ArrayXXcd& controller);

/// Gauss-Newton curvature of the boresight's mean square, a Hermitian matrix H per frequency, by
/// rows: a small change dK of the controller's response (a column per frequency) adds dK^H H dK,
/// summed over the frequencies and relative to the mean square, beyond what the gradient says. The
/// change of S counts to first order only.
Eigen::ArrayXXcd boresight_curvature(const SampledSpectrum& spectrum,
                                     const Eigen::ArrayXXcd& controller);

/// The same of the effort's mean square, whose H is diagonal: the diagonals, frequencies x sensors.
Eigen::ArrayXXd effort_curvature(const SampledSpectrum& spectrum,
                                 const Eigen::ArrayXXcd& controller);

}  // namespace boresight::design
