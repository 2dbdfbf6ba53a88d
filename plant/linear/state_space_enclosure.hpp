#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/numerics/taylor_model.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::plant {

/// Encloses the response C (j w I - A)^-1 B + D of a continuous state space over intervals of
/// frequency: nothing between two frequencies escapes. Each pole is enclosed by itself, so that an
/// interval may be as wide as its distance from the nearest pole; where the eigenvectors are too
/// dependent, the resolvent is (O(n^3) an interval then).
class StateSpaceEnclosure {
 public:
  /// @throws InvalidInput as validate(system), or if it is sampled.
  explicit StateSpaceEnclosure(const StateSpace& system);

  Eigen::Index rows() const { return system_.d.rows(); }
  Eigen::Index columns() const { return system_.d.cols(); }
  bool by_modes() const { return form_.has_value(); }
  /// Null where it is not taken by its modes.
  const ModalForm* form() const { return form_ ? &*form_ : nullptr; }

  /// Every element of the response, row by row; allocates nothing if `elements` has their number
  /// and the system is taken by its modes.
  void enclose(const numerics::FrequencyInterval& interval,
               std::vector<numerics::TaylorModel>& elements) const;

 private:
  struct Section {
    std::complex<double> pole;
    double pole_error;
    std::vector<double> level, slope, uncertainty;  // of each element
  };
  void by_sections(const numerics::FrequencyInterval& interval,
                   std::vector<numerics::TaylorModel>& elements) const;
  void by_resolvent(const numerics::FrequencyInterval& interval,
                    std::vector<numerics::TaylorModel>& elements) const;

  StateSpace system_;  // balanced
  std::optional<ModalForm> form_;
  std::vector<Section> sections_;
};

/// The inverse of s^2 + 2 damping s + stiffness over the interval, in a form that stays finite at
/// infinite frequency: 1/q where q = stiffness b^2 + 2 damping j a b - a^2 with w = a/b, b = 1 or,
/// reciprocal, a = 1. (w0, decay): the pole -decay + j w0; stiffness = w0^2 + decay^2.
numerics::TaylorModel resonance_inverse(double w0, double decay,
                                        const numerics::FrequencyInterval& interval);

}  // namespace boresight::plant
