#pragma once

#include <complex>

#include <boresight/identification/resonance/drive_response.hpp>

/// The steps of drive_response: transforms of a record's moving part and the fits on them.
namespace boresight::identification {

/// Transforms of a signal and of its derivative over a part, both under Hann's window. The
/// derivative is taken before the window, which preserves proportionality.
struct WindowedTransforms {
  Eigen::VectorXcd value;
  Eigen::VectorXcd derivative;
};

WindowedTransforms windowed_transforms(const Eigen::VectorXd& signal, const MovingPart& part,
                                       double sample_time);

/// Neighbouring bins of a transform, `bin` Hz apart.
struct FrequencyBand {
  double bin = 0.0;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  std::complex<double> s(Eigen::Index k) const;
};

/// Bins between two frequencies (Hz) of a transform with `bins` bins; empty if there is none
/// between.
FrequencyBand frequency_band(double lowest, double highest, double bin, Eigen::Index bins);

/// Real coefficients of complex equations, least squares.
struct RealFit {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  // Hann's window leaves two of three bins independent
  Eigen::VectorXcd residual;   // weighted
};

/// @throws NumericalFailure where there are fewer real equations than unknowns.
RealFit real_least_squares(const Eigen::MatrixXcd& columns, const Eigen::VectorXcd& right,
                           const Eigen::VectorXd& weight, Eigen::Index nonlinear, const char* what);

/// Noise of a bin of the transforms.
struct BinNoise {
  double torque = 0.0;
  double rate = 0.0;
};

/// The residual at twice `highest` (Hz) or at the transforms' end, whichever is larger.
BinNoise bin_noise(const WindowedTransforms& rate, const WindowedTransforms& torque, double highest,
                   double bin);

struct ImpedanceFit {
  Eigen::VectorXd poles;            // log frequency (Hz), log damping ratio of each mode
  RealFit linear;                   // B, J0, J of each mode
  Eigen::MatrixXd pole_covariance;  // of the fitted ones
  double total = 0.0;               // kg m2
};

/// Columns of the impedance's linear part at given poles: rate, its derivative, and the derivative
/// through each mode.
Eigen::MatrixXcd impedance_columns(const WindowedTransforms& rate, const FrequencyBand& band,
                                   const Eigen::VectorXd& poles);

/// MechanicalImpedance over a band: the poles of the first `fitted` modes within `tolerance` (of
/// log frequency) of their centres (Hz), the others' at them with a damping ratio of 0.01.
ImpedanceFit fit_impedance(const WindowedTransforms& rate, const WindowedTransforms& torque,
                           const FrequencyBand& band, const BinNoise& noise,
                           const Eigen::VectorXd& centres, Eigen::Index fitted, double tolerance);

/// True if a band of frequencies (Hz), and the inner part with which fit_oil_relation compares it,
/// has three bins for each of the relation's five parameters.
bool shows_oil_relation(double lowest, double highest, double bin);

/// OilRelation without its orifices' part, over `lowest` .. `highest` (Hz). `scale`: relative
/// uncertainty of torque.
OilRelation fit_oil_relation(const WindowedTransforms& torque, const WindowedTransforms& rate,
                             const WindowedTransforms& command, double lowest, double highest,
                             double bin, double scale, double tachometer);

/// Adds the hydraulic mode of a response's impedance and an oil relation to the response.
void add_hydraulic_mode(DriveResponse& response, const OilRelation& oil);

/// value with a statistical uncertainty and a relative one.
numerics::Interval scaled_interval(double value, double statistical, double relative);

}  // namespace boresight::identification
