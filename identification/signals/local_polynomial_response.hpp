#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::identification {

struct LocalPolynomialOptions {
  /// Hz, the band asked for: where the input has power.
  double lowest_frequency = 0.0;
  double highest_frequency = 0.0;
  /// Degree of the polynomials in frequency that response and transient are taken for.
  int degree = 2;
  /// Transform bins on either side of each frequency. 2 half_width - 2 degree - 1 degrees of
  /// freedom are left for the noise.
  int half_width = 7;
};

/// Responses from one input to several outputs at the bins of a record's Fourier transform, with
/// their errors estimated from the record.
struct MultipleResponseEstimate {
  Eigen::VectorXd frequency;  // Hz
  Eigen::MatrixXcd response;  // frequencies x outputs, output per input
  /// One a frequency, outputs x outputs, Hermitian: E[e e^H] of the responses' complex errors. What
  /// disturbs several outputs at once (gusts, friction) stands beside the diagonal.
  std::vector<Eigen::MatrixXcd> covariance;
  /// frequencies x outputs: |G|^2/(|G|^2 + n E|e|^2), n the degrees of freedom: the coherence by
  /// which Bendat and Piersol's uncertainty is the one stated here.
  Eigen::MatrixXd coherence;
  Eigen::Index degrees_of_freedom = 0;
};

/// The local polynomial method (R. Pintelon, J. Schoukens, G. Vandersteen, K. Barbe, Estimation of
/// nonparametric noise and FRF models for multivariable systems, Mechanical Systems and Signal
/// Processing 24, 2010): around each bin of one transform of the whole record, without window,
///   Y(k+r) = G(k+r) U(k+r) + T(k+r) + V,   r = -half_width .. half_width,
/// by least squares with polynomials for the response G and for the transient T, which holds what
/// was ringing at the begin of the record and still does at its end. So a single sweep is used at
/// its full resolution, and leakage does not pass for noise. The input is taken as exact (a
/// command); noise is that of the outputs. Straight lines are taken out of all signals first.
/// O(N log N + bins).
/// @throws InvalidInput for series of different or too short length, a sample time, band, degree or
/// width out of range; NumericalFailure where the input does not tell response and transient apart
/// (no power, or an impulse).
MultipleResponseEstimate local_polynomial_response(const Eigen::VectorXd& input,
                                                   const Eigen::MatrixXd& outputs,
                                                   double sample_time,
                                                   const LocalPolynomialOptions& options);

}  // namespace boresight::identification
