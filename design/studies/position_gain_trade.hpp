#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>

namespace boresight::design {

/// Where a slow rate loop hardly acts, position and rate gain count by their product: how far the
/// position gain of a controller can be lowered (a hundredfold at most), the product and all other
/// gains fixed, before the rms on the nominal plant is 1 % larger or the loop unstable.
struct PositionGainTrade {
  control::ControlLaw law;                       // so lowered
  std::size_t position_gain = 0, rate_gain = 0;  // places in its gains
  double beam_rms = 0.0;                         // rad
  int within_goals = 0;  // members of the ensemble on which it keeps every constraint
};

/// Whether a gain that ends at a bound of its search does so at the upper one: the nearer of the
/// two in the logarithm.
bool ends_at_upper(const control::GainDescription& gain, double value);

/// Whether a search ended at the upper bound of the position gain, with a rate gain to trade it
/// against: gains of the symbols kp and kr.
bool ends_at_position_gain(const TuningResult& tuning);

/// The trade of a controller that points within `beam_rms` (rad) on the problem's plant in its
/// wind, evaluated on members that may be empty. None unless ends_at_position_gain and the position
/// gain can be halved or lowered further. Ten evaluations of a controller and one of all members.
std::optional<PositionGainTrade> position_gain_trade(TrackingProblem problem,
                                                     const TuningResult& tuning, double beam_rms,
                                                     const HardGoals& goals,
                                                     const std::vector<EnsembleMember>& members);

}  // namespace boresight::design
