#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>

namespace boresight::design {

/// With a slow, nearly inactive rate loop only the product of position and rate gain matters. The
/// trade lowers a controller's position gain, at most a hundredfold, with the product and all other
/// gains fixed. It stops before the rms on the nominal plant is 1 % larger or the loop unstable.
struct PositionGainTrade {
  control::Controller controller;                // with the lowered gain
  std::size_t position_gain = 0, rate_gain = 0;  // indices into its gains
  double boresight_rms = 0.0;                    // rad
  int within_constraints = 0;  // ensemble members on which it meets every constraint
};

/// True if a gain that ends at a bound of its search does so at the upper one: the nearer of the
/// two in the logarithm.
bool ends_at_upper(const control::GainDescription& gain, double value);

/// True if a search ended at the upper bound of the position gain and the structure has a rate
/// gain: gains of the symbols kp and kr.
bool ends_at_position_gain(const TuningResult& tuning);

/// The trade of a controller whose boresight rms is within `boresight_rms` (rad) on the problem's
/// plant in its wind, evaluated on members (may be empty). None unless ends_at_position_gain and
/// the position gain can be halved or lowered further. Cost: ten evaluations of a controller and
/// one of all members.
std::optional<PositionGainTrade> position_gain_trade(TrackingProblem problem,
                                                     const TuningResult& tuning,
                                                     double boresight_rms, const Constraints& goals,
                                                     const std::vector<EnsembleMember>& members);

}  // namespace boresight::design
