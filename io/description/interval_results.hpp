#pragma once

#include <optional>
#include <string_view>

#include <boresight/io/description/visitor.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::io {

/// A result with its central 95 % interval; its unit, which has many, stands beside it ("1" for an
/// empty one).
void describe_interval(Visitor& v, std::string_view key, const numerics::Interval& interval,
                       std::string_view unit, std::string_view meaning);
/// null where there is none.
void describe_interval(Visitor& v, std::string_view key,
                       const std::optional<numerics::Interval>& interval, std::string_view unit,
                       std::string_view meaning);

}  // namespace boresight::io
