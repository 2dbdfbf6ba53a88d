#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>

namespace boresight::design {

/// A stage before it was looked at.
struct PathStage {
  StageKind kind = StageKind::rate_loop;
  StageLaw law;
};

/// The law of which `found` is a law too, gain by gain of `target`'s structure: paths that found
/// does not have are left out of its structure, other blocks that it does not have stand where they
/// do nothing. Nothing if found has a gain or path that the target has not.
std::optional<control::ControlLaw> law_within(const control::ControlLaw& found,
                                              const control::ControlLaw& target);

/// The law without its pressure and compliance path.
control::ControlLaw without_torque_paths(const control::ControlLaw& law);

/// The law with the gain of its rate path divided by one factor, gain and integral corner of its
/// position path by another. The same for both leaves one loop inside the other as it was.
control::ControlLaw detuned(const control::ControlLaw& law, double rate_factor,
                            double position_factor);

/// The order of work of plan_commissioning, from `start` (a law within the target's structure) to
/// `target`, both left out but for the start with its position loop open and the target. `allowed`:
/// whether every plant allows a law. Nothing, and why, where no path of such steps was found.
std::optional<std::vector<PathStage>> commissioning_path(
    const control::ControlLaw& start, const control::ControlLaw& target, double largest_step,
    const std::function<bool(const StageLaw&)>& allowed, std::string& why_not);

}  // namespace boresight::design
