#pragma once

#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_simulation.hpp>

namespace boresight::identification {

/// Reduction of the intervals by one test, repeated or new.
struct GreyBoxInformationGain {
  std::string test;
  TestKind kind = TestKind::other;
  bool done_before = false;  // a record of this kind is in the campaign
  /// Standard uncertainty after the test over that before, for each of the result's quantities in
  /// their order; 1: nothing gained.
  std::vector<double> remaining;
};

/// The tests of a full campaign, as the fitted drive would run them: slosh, ramps, constant speeds
/// (slow, middle, fast), valve steps and valve sweep. Speeds follow those of the records.
std::vector<GreyBoxManoeuvre> campaign_tests(const GreyBoxResult& result, double largest_rate);

/// Ranks the tests by their information gain for a quantity, the best first. Each test is simulated
/// by the fitted drive (simulate_drive). Its Fisher information, by the records' own prediction
/// errors, is discounted as much as the posterior was widened and added to the posterior's.
/// Uncertainty that no test removes (transducers' gains, model discrepancies) is kept. First order
/// about the optimum.
/// @throws InvalidInput as GreyBoxResult::quantity.
std::vector<GreyBoxInformationGain> rank_tests(const GreyBoxResult& result,
                                               const Campaign& campaign,
                                               const std::string& quantity);

}  // namespace boresight::identification
