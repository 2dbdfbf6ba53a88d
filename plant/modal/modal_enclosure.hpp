#pragma once

#include <string_view>
#include <vector>

#include <boresight/plant/linear/state_space_enclosure.hpp>
#include <boresight/plant/modal/modal_reduction.hpp>

namespace boresight::plant {

/// Encloses the response of a modal system from one input to one output over intervals of
/// frequency, from the modes themselves: O(modes) an interval, exact dead times. The enclosure is
/// sharp to third order in the interval's width relative to the distance of the nearest pole of
/// core and modes.
class ModalEnclosure {
 public:
  /// @throws as reduce().
  ModalEnclosure(const ModalSystem& system, std::string_view input, std::string_view output);

  /// Not to be called from two threads at a time: it keeps its work arrays. Allocates nothing after
  /// the first call.
  numerics::TaylorModel enclose(const numerics::FrequencyInterval& interval);

  /// The largest magnitude of a pole of core or modes, with a dead time as one of 1/delay: rad/s.
  double highest_pole() const;

 private:
  void sum_modes(const numerics::FrequencyInterval& interval);
  /// From drive k to return j: the displacement, and its rate (both zero where there is no path).
  const numerics::TaylorModel* path(std::size_t j, std::size_t k) const;
  const numerics::TaylorModel* rate_path(std::size_t j, std::size_t k) const;
  /// What row `row` of the core makes of return j moved by drive k, added to `sum`.
  void add_return(numerics::TaylorModel& sum, Eigen::Index row, std::size_t j,
                  const numerics::TaylorModel& moved, const numerics::TaylorModel& moved_rate,
                  double half_width) const;

  ModalReduction reduction_;
  StateSpaceEnclosure core_;
  std::vector<int> path_number_;  // [return * drives + drive], -1 where there is none
  std::vector<std::size_t> mode_path_;
  std::vector<double> mode_gain_;   // [mode * paths + path]
  std::vector<double> mode_decay_;  // zeta w
  // Work arrays.
  std::vector<numerics::TaylorModel> elements_;
  std::vector<numerics::TaylorModel> transfer_, rate_transfer_;  // [path]
  std::vector<numerics::TaylorModel> drive_, moved_, moved_rate_, matrix_;
  std::vector<std::size_t> looped_;
};

}  // namespace boresight::plant
