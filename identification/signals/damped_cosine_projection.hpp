#pragma once

#include <vector>

#include <boresight/identification/signals/damped_cosine.hpp>

/// The steps of fit_damped_cosines: variable projection on one window.
namespace boresight::identification::ring {

struct Window {
  const Eigen::MatrixXd& signals;
  double sample_time;
  double lowest;           // Hz, of a pole
  double largest_damping;  // decay rate over w
  double length() const { return static_cast<double>(signals.rows()) * sample_time; }
};

Window window_of(const Eigen::MatrixXd& signals, double sample_time, const RingFitOptions& options);

/// @throws InvalidInput, naming `function`, for signals or poles that cannot be fitted.
void check(const Window& window, const std::vector<RingPole>& poles, const char* function);

/// Trend, slow cosines and the poles that are not fitted.
Eigen::MatrixXd background_columns(Eigen::Index samples, double sample_time,
                                   const RingFitOptions& options);

/// Thin QR by Gram and Schmidt's process, every column made orthogonal twice; a column that the
/// ones before it explain becomes 0.
struct Orthonormal {
  Eigen::MatrixXd q;
  Eigen::MatrixXd r;
};

void append_columns(Orthonormal& basis, const Eigen::MatrixXd& columns);

/// The fit's state at one set of poles.
struct Projection {
  Orthonormal basis;             // background, then two columns a pole
  Eigen::MatrixXd modal;         // the poles' columns
  Eigen::MatrixXd residual;      // samples x channels, not weighted
  Eigen::MatrixXd coefficients;  // two a pole, x channels
};

Projection project(const Window& window, const Orthonormal& background,
                   const std::vector<RingPole>& poles);

/// Derivatives of the weighted residuals (channels one below the other) to log w, log s of each
/// pole.
Eigen::MatrixXd jacobian(const Window& window, const Projection& at,
                         const std::vector<RingPole>& poles, const Eigen::VectorXd& weight);

Eigen::VectorXd rms_of(const Eigen::MatrixXd& residual);

/// Levenberg and Marquardt's descent.
struct Descent {
  std::vector<RingPole> poles;
  Projection at;
  bool converged = false;
  int iterations = 0;
};

Descent descend(const Window& window, const Orthonormal& background,
                const std::vector<RingPole>& poles, const Eigen::VectorXd& weight,
                int max_iterations);

}  // namespace boresight::identification::ring
