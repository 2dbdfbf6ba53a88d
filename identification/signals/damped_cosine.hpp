#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// A pole pair -s +- j w of a free oscillation: e^(-s t) cos(w t + phase), t from the window's
/// first sample.
struct RingPole {
  double damped_frequency = 0.0;  // w/(2 pi), Hz
  double decay_rate = 0.0;        // s, 1/s
};

/// What a fit of damped cosines may do.
struct RingFitOptions {
  /// Degree of the polynomial under the oscillation (-1: none).
  int trend_degree = 1;
  /// Hz: slower content is removed by cosines over the window up to this frequency, and no pole is
  /// searched for below it (0: only the polynomial).
  double low_frequency_limit = 0.0;
  /// Poles that are present with amplitudes of their own but are not fitted.
  std::vector<RingPole> fixed_poles;
  double largest_damping_ratio = 0.98;
  int max_iterations = 60;
};

/// One fitted pole pair.
struct RingMode {
  RingPole pole;
  numerics::Interval natural_frequency;  // sqrt(w^2 + s^2)/(2 pi), Hz
  numerics::Interval damping_ratio;      // s/sqrt(w^2 + s^2), not below 0
  /// One a channel: the oscillation is Re(amplitude e^((-s + j w) t)).
  Eigen::VectorXcd amplitude;
};

struct RingFit {
  std::vector<RingMode> modes;   // in the order of the starts
  Eigen::VectorXd residual_rms;  // one a channel
  Eigen::MatrixXd oscillation;   // samples x channels, of the fitted poles alone
  Eigen::MatrixXd residual;
  /// Of (log w, log s) of each mode in turn, then of the amplitudes (Re, Im of each mode) of each
  /// channel in turn: of the noise that the residuals show, with their correlation in time where
  /// it adds to the variance.
  Eigen::MatrixXd covariance;
  bool converged = false;
  int iterations = 0;
};

/// Whether a window of so many samples (`sample_time` s apart) has the four samples a coefficient
/// that fit_damped_cosines needs for so many starts.
bool can_fit_rings(Eigen::Index samples, double sample_time, std::size_t starts,
                   const RingFitOptions& options = {});

/// Fits damped cosines common to all channels, with amplitudes and a trend for each channel.
/// Nonlinear least squares in log w and log s with the linear coefficients eliminated (variable
/// projection: Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973; Kaufman's derivative) and
/// Levenberg-Marquardt damping. Channels are weighted by their residuals' rms. The decay rate is at
/// least 0.001 over the window's length.
/// `channels`: samples x channels, evenly spaced by `sample_time` (s). `starts` within a fraction
/// of 1/window length of the truth: ring_starts. Cost: samples x columns x modes x channels per
/// iteration.
/// @throws InvalidInput for no start, fewer samples than four times the coefficients of a channel,
/// values that are not finite, start frequencies outside 0 .. half the sampling rate;
/// NumericalFailure if modes cannot be separated (singular least squares).
RingFit fit_damped_cosines(const Eigen::MatrixXd& channels, double sample_time,
                           const std::vector<RingPole>& starts, const RingFitOptions& options = {});

/// Where to start: the `count` strongest oscillations between `lowest` and `highest` (Hz), one
/// after the other. Each maximises, over frequency and decay rate, the energy that a damped cosine
/// explains (a Fourier transform of the signal weighted with each of a few decays), then all found
/// so far are fitted and taken out. Fewer where the rest of the signal has no maximum inside the
/// band.
/// @throws InvalidInput as fit_damped_cosines, and for a band that is not 0 <= lowest < highest <=
/// half the sampling rate.
std::vector<RingPole> ring_starts(const Eigen::MatrixXd& channels, double sample_time, int count,
                                  double lowest, double highest,
                                  const RingFitOptions& options = {});

}  // namespace boresight::identification
