#pragma once

#include <string_view>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// The place where a loop is opened.
void describe_break(Visitor& v, std::string_view key, control::LoopBreak loop_break);

/// "loop_breaks": the constraints on a loop opened at each of control::loop_breaks.
void describe_breaks(Visitor& v, const design::Constraints& goals);

/// The smallest margins of one loop, opened at one place: gain, phase, delay.
void describe(Visitor& v, const control::Margins& margins);
/// The loop's maximum sensitivity Ms and its frequency.
void describe_sensitivity(Visitor& v, const control::Margins& margins);

/// Detail reported of a search for a limit cycle.
enum class LimitCycleDetail {
  score,  // whether there is one, its boresight amplitude and frequency
  study,  // how many runs had one, and the encoder's amplitude
  full,   // why a run did not complete, and whether the amplitude lasts
};
/// The loop's free motion at a steady rate.
void describe(Visitor& v, const design::LimitCycleResult& result, LimitCycleDetail detail);

/// "status": how a run ended.
void describe_status(Visitor& v, design::RunStatus status,
                     std::string_view meaning = "How the run ended.");

}  // namespace boresight::io
