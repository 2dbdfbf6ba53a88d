#pragma once

#include <array>
#include <complex>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/numerics/complex_packs.hpp>

namespace boresight::design {

/// One complex number per sensor at eight neighbouring frequencies.
using SensorPack = std::array<numerics::ComplexPack, 3>;

/// A controller's response (SampledSetting::controller_response), eight frequencies side by side,
/// the last pack filled up with zeros.
std::vector<SensorPack> packed_response(const Eigen::ArrayXXcd& controller);

/// ln of an rms and its gradient: d logarithm = 2 Re sum(gradient * dK) over all frequencies and
/// sensors, K the controller's response. Zero beyond the last frequency in the last pack.
struct RmsFigure {
  double logarithm = 0.0;
  std::vector<SensorPack> gradient;
};

/// ln of a peak and its gradient, in the same sense, at the frequencies where it is not 0.
struct PeakFigure {
  struct Point {
    Eigen::Index frequency = 0;  // its place on the grid
    std::array<std::complex<double>, 3> gradient;
  };
  double logarithm = 0.0;
  std::vector<Point> points;
};

/// Of a loop that is stable, which is not tested here.
struct LoopPeaks {
  /// Of |S| at the valve command: ln(sum |S|^p)/p over the frequencies where it is next to its
  /// largest, a smooth upper bound of ln Ms at the frequencies.
  PeakFigure sensitivity_peak;
  /// The same of |S| with the loop cut at the encoder alone, tachometer and torque fed back: of the
  /// position loop.
  PeakFigure position_peak;
};
/// Likewise.
struct LoopFigures {
  RmsFigure boresight_rms;   // rad of motor
  RmsFigure control_effort;  // rad/s
  LoopPeaks peaks;
};

/// The figures of the loop on one plant: about 300 operations a frequency, on as many frequencies
/// at once as the processor's registers hold; the same bits for every width (NarrowRegisters).
/// Where a response is not finite, the figures are not either.
class LoopFigureEvaluator {
 public:
  explicit LoopFigureEvaluator(const SampledSpectrum& spectrum);

  /// `controller`: packed_response at the spectrum's frequencies, which is not tested.
  LoopFigures figures(const std::vector<SensorPack>& controller) const;
  /// The peaks alone, without mean squares and their gradients.
  LoopPeaks peaks(const std::vector<SensorPack>& controller) const;
  /// As sensitivity_peak, of the gain from encoder to motor torque with the motor locked
  /// (SampledSetting::highest_locked_motor_gain).
  PeakFigure locked_motor_gain(const std::vector<SensorPack>& controller) const;

 private:
  template <bool with_rms>
  struct Kernel;
  struct Sweep;
  /// SampledSpectrum at eight frequencies.
  struct Pack {
    SensorPack response;
    std::array<numerics::RealPack, 3> variances;       // densities of the sensors,
    std::array<numerics::ComplexPack, 3> covariances;  // of 0 with 1, 0 with 2, 1 with 2
    SensorPack cross;
    numerics::RealPack boresight, by_command, weight;
  };
  LoopPeaks peaks_of(const Sweep& sweep, const std::vector<SensorPack>& controller) const;

  std::vector<Pack> packs_;
  Eigen::Index count_ = 0;  // of frequencies
  std::array<double, 3> noise_{};
  double unavoidable_cost_ = 0.0;
};

}  // namespace boresight::design
