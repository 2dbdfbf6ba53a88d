#pragma once

#include <optional>
#include <string>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/studies/redesign_study.hpp>
#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// A controller on its plant in one wind, with everything that determines its boresight rms,
/// stability, margins and step responses. The page recomputes these when gains, wind speed, oil
/// stiffness, leakage rate and friction slope change. The rms equals that of make_evaluator at the
/// problem's wind speed; no wind climate is included.
struct AdjustableLoop {
  std::string structure;           // as the user has it
  control::Controller controller;  // stable on the problem's plant
  TrackingProblem problem;
  Constraints goals;
};

/// The recommended controller of a redesign, or the loops beside it where it is a state space,
/// which has no gains. None if that controller is not stable.
std::optional<AdjustableLoop> adjustable_loop(const RecommendedDesign& recommended);

/// A controller of a tuning study at its own wind speed, or recommended_loops where it is a state
/// space. None if these are not stable.
std::optional<AdjustableLoop> adjustable_loop(const TuningStudy& study, const TunedController& row);

}  // namespace boresight::design
