#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/equations/schur_lyapunov.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::control {

/// Distance of eigenvalues of A from uncontrollability by B, by the test of Popov, Belevitch and
/// Hautus. It computes the rank of [A - s I, B] at every eigenvalue s, and at the means of
/// clustered eigenvalues (where A has chains the mean is far more accurate than its members). Works
/// on the Schur form of A with an O(n^2 inputs) triangularisation and inverse iteration at each s;
/// no powers of A.
class ModeDistance {
 public:
  /// `schur`: of A in balanced states; `b`: in the same states; `norm`: |A|, Frobenius.
  ModeDistance(const numerics::RealSchur& schur, const Eigen::MatrixXd& b, double norm,
               TimeDomain domain);

  /// A number at which the rank was tested.
  struct Mode {
    std::complex<double> eigenvalue;
    /// Smallest singular value of [A - s I, B] over |A| (Frobenius), with every column of B scaled
    /// to |A|. This is the distance, relative to A, of the nearest system in which the mode is
    /// uncontrollable.
    double distance = 0.0;
  };

  /// The rank of [A - s, B] at one number, eigenvalue or not.
  Mode test(std::complex<double> s);
  /// The eigenvalues with Im >= 0 that are both unstable and uncontrollable to `tolerance`. If the
  /// mean of a cluster of eigenvalues is uncontrollable, it represents the cluster.
  std::vector<Mode> unreached_unstable(double tolerance);

  /// Stable by more than the rounding of eigenvalues, 10 n eps |A| (10 n eps in sampled time).
  bool stable(std::complex<double> eigenvalue) const;

 private:
  Mode test_with_neighbours(std::complex<double> s, double tolerance);
  void triangularise(std::complex<double> s);

  numerics::ComplexSchur schur_;
  Eigen::MatrixXcd b_;  // in Schur coordinates, columns of length norm_
  double norm_;
  TimeDomain domain_;
  Eigen::MatrixXcd triangle_, rest_;  // [T - s, B] with B rotated away
};

/// Those of `modes` that are uncontrollable in the given states too. Balancing can amplify a
/// coupling that is only a rounding error and thereby scale down other couplings.
std::vector<ModeDistance::Mode> confirm_unreached(std::vector<ModeDistance::Mode> modes,
                                                  const Eigen::MatrixXd& a,
                                                  const Eigen::MatrixXd& b, TimeDomain domain,
                                                  double tolerance);

/// "2", "-0.1 +- 3 j"
std::string describe_eigenvalue(std::complex<double> eigenvalue);

}  // namespace boresight::control
