#pragma once

#include <string_view>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Where a loop is cut.
void describe_break(Visitor& v, std::string_view key, control::LoopBreak loop_break);

/// "loop_breaks": the constraints on a loop cut at each of control::loop_breaks.
void describe_breaks(Visitor& v, const design::HardGoals& goals);

/// The smallest margins of one loop, cut at one place: gain, phase, delay.
void describe(Visitor& v, const control::Margins& margins);
/// The loop's largest sensitivity and where it is.
void describe_sensitivity(Visitor& v, const control::Margins& margins);

/// How much of a search for a limit cycle is told.
enum class LimitCycleDetail {
  score,  // whether there is one, of which beam amplitude and frequency
  study,  // how many runs had one, and the encoder's amplitude
  full,   // why a run did not complete, and whether the amplitude lasts
};
/// What the loop does by itself at a steady rate.
void describe(Visitor& v, const design::HuntingResult& result, LimitCycleDetail detail);

/// "status": how a run ended.
void describe_status(Visitor& v, design::RunStatus status,
                     std::string_view meaning = "How the run ended.");

}  // namespace boresight::io
