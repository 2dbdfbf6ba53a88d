#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

/// A case's tests at steady rates (FrictionCurveEntry::tests) as the fit takes them, in their
/// order, for identification::steady_friction_intervals.
std::vector<identification::SteadyFriction> steady_friction(
    const std::vector<SteadyFrictionTest>& tests);

/// Whether an end of the search is all that bounds a number, or it is open by a factor of more than
/// 1.5.
bool is_loose(const identification::FrictionInterval& interval);

/// The Stribeck rate of a curve that has as many unknowns as tests, where those, each torque moved
/// by its leeway, leave it loose. None of any other curve.
std::optional<identification::FrictionInterval> loose_stribeck_rate(
    const FrictionCurveEntry& curve);

/// That in a sentence, and what hangs on it; empty without one.
std::string loose_stribeck_text(const FrictionCurveEntry& curve);

/// Adds that sentence, if there is one, of an antenna that is run on its nonlinear drive.
void conclude_friction_doubt(const Case& antenna, std::vector<std::string>& sentences);

/// "1.75 (its bound) to 3.47 rad/s", "1.75 rad/s (its bound) or less"; of SI numbers.
std::string in_words(const identification::FrictionInterval& interval, std::string_view unit);

/// How the torques are moved for the intervals: begins a sentence that says what comes of it.
std::string_view moved_torques();

}  // namespace boresight::io
