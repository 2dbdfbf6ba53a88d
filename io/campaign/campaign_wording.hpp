#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/identification/grey_box/grey_box_information_gain.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::io {

/// A unit as reports show it, and what an SI number is multiplied by.
struct ShownUnit {
  std::string name;  // "MPa" for Pa, "ms" for s, "kg.m2" for "kg m2", "1" for none
  double scale = 1.0;
};
ShownUnit shown_unit(const std::string& unit);

/// Four digits; "inf".
std::string significant(double value);

/// "1.741 .. 1.82": four digits each.
std::string range(const numerics::Interval& interval, double scale = 1.0);

/// Quantities (GreyBoxQuantity::name) that tests are ranked for.
bool advised_quantity(std::string_view name);

/// The tests by what they leave of a quantity's interval, the least first.
std::vector<const identification::GreyBoxInformationGain*> ranked(
    const std::vector<identification::GreyBoxInformationGain>& gains, std::size_t quantity);

}  // namespace boresight::io
