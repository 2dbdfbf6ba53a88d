#pragma once

#include <Eigen/Core>

namespace boresight::plant {

/// What is nonlinear in a system that is linear elsewhere: n = n(z), without memory. States such as
/// the deflection of a bristle stand in the linear part, as integrators that a channel drives.
class NonlinearChannels {
 public:
  virtual ~NonlinearChannels() = default;

  virtual Eigen::Index inputs() const = 0;   // p
  virtual Eigen::Index outputs() const = 0;  // q

  /// n (q) at z (p) and dn/dz (q x p), of which every element is to be written. Called in inner
  /// loops: it must not allocate. Where n has a kink, dn/dz of either side; a jump of n is beyond
  /// the integrators. Outside its range of validity n may be NaN: the integrators then try a
  /// shorter step and end with an error that names the channel.
  virtual void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                        Eigen::Ref<Eigen::MatrixXd> dn_dz) const = 0;
};

}  // namespace boresight::plant
