#pragma once

#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_simulation.hpp>

namespace boresight::identification {

/// By how much a test, done once more or for the first time, would shrink an interval.
struct GreyBoxTestGain {
  std::string test;
  TestKind kind = TestKind::other;
  bool done_before = false;  // a record of this kind is in the campaign
  /// Standard uncertainty after over before, of each of the result's quantities, in their order: 1
  /// says nothing gained.
  std::vector<double> remaining;
};

/// The tests of a full campaign, as the fitted drive would run them: slosh, ramps, constant speeds
/// (slow, middle, fast), valve steps and valve sweep. Speeds by what the records reached.
std::vector<GreyBoxManoeuvre> campaign_tests(const GreyBoxResult& result, double largest_rate);

/// Ranks the tests by what they would gain for a quantity, the best first: each is simulated by the
/// fitted drive (simulate_drive), its Fisher information, by the records' own prediction errors and
/// as much discounted as the posterior was widened, added to the posterior's. What no test removes
/// (transducers' gains, discrepancies of the model's laws) is kept. First order about the optimum.
/// @throws InvalidInput as GreyBoxResult::quantity.
std::vector<GreyBoxTestGain> rank_tests(const GreyBoxResult& result, const Campaign& campaign,
                                        const std::string& quantity);

}  // namespace boresight::identification
