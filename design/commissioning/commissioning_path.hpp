#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/commissioning/commissioning.hpp>

namespace boresight::design {

/// A stage before its evaluation.
struct PathStage {
  StageKind kind = StageKind::rate_loop;
  StageController controller;
};

/// Expresses the controller `found` in the structure of `target`, gain by gain. Paths that found
/// does not have are omitted from the structure; other blocks that it does not have are set to no
/// effect. None if found has a gain or path that the target does not have.
std::optional<control::Controller> controller_within(const control::Controller& found,
                                                     const control::Controller& target);

/// The controller without its pressure and compliance paths.
control::Controller without_torque_paths(const control::Controller& controller);

/// The controller with the gain of its rate path divided by one factor, and gain and integral
/// corner of its position path by another. Equal factors preserve the relation between inner and
/// outer loop.
control::Controller detuned(const control::Controller& controller, double rate_factor,
                            double position_factor);

/// The sequence of stages of plan_commissioning from `start` (a controller within the target's
/// structure) to `target`. It excludes both, except the start with its position loop open and the
/// target. `allowed`: returns whether every plant allows a controller. None, with the reason in
/// `why_not`, where no path of such steps was found.
std::optional<std::vector<PathStage>> commissioning_path(
    const control::Controller& start, const control::Controller& target, double largest_step,
    const std::function<bool(const StageController&)>& allowed, std::string& why_not);

/// The same to a state space, by factors on its output that rise to 1, each by the largest step,
/// with feedforward throughout. The first is the least that can be raised so, a quarter or the next
/// step below it at the lowest.
std::optional<std::vector<PathStage>> output_path(
    const control::Controller& target, double largest_step,
    const std::function<bool(const StageController&)>& allowed, std::string& why_not);

}  // namespace boresight::design
