#pragma once

#include <optional>
#include <string>

#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::app {

/// From which height to which the case's wind speeds were converted, in a sentence.
std::string mast_in_words(const plant::WindMast& mast);

/// To stand behind a speed in m/s at the dish's centre: " at the dish, 7 at the mast"; empty where
/// the case states speeds there.
std::string dish_and_mast(const std::optional<plant::WindMast>& mast, double speed);

/// The same behind a speed of a table, " (7)", and what it is behind the column's "m/s".
std::string speed_at_mast(const std::optional<plant::WindMast>& mast, double speed);
std::string mast_column(const std::optional<plant::WindMast>& mast);

/// For the head of conclusions, that speeds are those at the dish and what makes them the mast's.
std::string conclude_mast(const plant::WindMast& mast);

}  // namespace boresight::app
