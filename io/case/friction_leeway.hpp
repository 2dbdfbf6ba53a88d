#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// True if the number is bounded only by the end of the search, or its interval is wider than a
/// factor of 1.5.
bool is_loose(const identification::FrictionInterval& interval);

/// The Stribeck rate of a curve with as many unknowns as tests, if moving each torque by its leeway
/// leaves it loose (is_loose). Nothing for any other curve.
std::optional<identification::FrictionInterval> loose_stribeck_rate(
    const FrictionCurveEntry& curve);

/// States that in a sentence, with the quantities that depend on it; empty without one.
std::string loose_stribeck_text(const FrictionCurveEntry& curve);

/// Adds that sentence, if there is one, for an antenna that is run on its nonlinear drive.
void conclude_friction_doubt(const Case& antenna, std::vector<std::string>& sentences);

/// "1.75 (its bound) to 3.47 rad/s", "1.75 rad/s (its bound) or less"; of SI numbers.
std::string in_words(const identification::FrictionInterval& interval, std::string_view unit);

/// The rule by which the torques are moved for the intervals, as the start of a sentence.
std::string_view moved_torques();

}  // namespace boresight::io
