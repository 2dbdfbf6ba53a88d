#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// The remark on keys in every schema ("$comment").
inline constexpr std::string_view schema_comment =
    "A key that holds a number ends in its unit: _1 (none), _N_m, _mdeg, ... Counts are whole "
    "numbers and have none. null stands for what is infinite, undefined or not there.";

/// The keys that begin a report: "program", "version", "command", which is one of `commands` where
/// the report is that of several.
void describe_origin(io::Visitor& v, std::string_view command,
                     std::span<const std::string_view> commands = {});
/// "axis", "boresight_factor_1": the axis, and what its error is worth at the sky.
void describe_axis(io::Visitor& v, const io::PointingAxis& axis);
/// "case": the file, its title and axis.
void describe_case(io::Visitor& v, std::string_view path, std::string_view title,
                   const io::PointingAxis& axis);
/// "superseded_inputs": what records have replaced of the case.
void describe_superseded(io::Visitor& v, const std::vector<io::SupersededInput>& inputs);
/// "assumed_inputs": inputs whose value or uncertainty is assumed.
void describe_assumed(io::Visitor& v, const std::vector<io::Quantity>& assumed);
/// "renamed_keys", of every report: io::renamed_keys.
void describe_renamed_keys(io::Visitor& v);
/// "fraction_of_time": fraction of the climate's time up to a speed (m/s); null without a climate
/// or if the speed is not a number.
void describe_fraction_of_time(io::Visitor& v, const std::vector<design::ClimatePart>& climate,
                               double speed, std::string_view meaning);

}  // namespace boresight::app
