#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/app/io/case_file.hpp>
#include <boresight/identification/steady_friction.hpp>

namespace boresight::app {

/// A case's tests at steady rates (FrictionCurveEntry::tests) as the fit takes them, in their
/// order, for identification::steady_friction_intervals.
std::vector<identification::SteadyFriction> steady_friction(
    const std::vector<SteadyFrictionTest>& tests);

/// The Stribeck rate of a curve that has as many unknowns as tests, where those, each torque moved
/// by its leeway, leave it open by a factor of more than 1.5. None of any other curve.
std::optional<identification::FrictionInterval> loose_stribeck_rate(
    const FrictionCurveEntry& curve);

/// That in a sentence, and what hangs on it; empty without one.
std::string loose_stribeck_text(const FrictionCurveEntry& curve);

/// "1.75 (its bound) to 3.47 rad/s", "1.75 rad/s (its bound) or less"; of SI numbers.
std::string in_words(const identification::FrictionInterval& interval, std::string_view unit);

/// How the torques are moved for the intervals: begins a sentence that says what comes of it.
std::string_view moved_torques();

}  // namespace boresight::app
