#pragma once

#include <numbers>
#include <string>
#include <string_view>

#include <boresight/numerics/angles.hpp>

namespace boresight::io {

/// The unit in which a described number is written, named by the end of its key:
/// written = SI value * multiplier / divisor, or 20 log10(SI value) in decibels.
struct KeyUnit {
  std::string_view suffix = {};  // "mdeg_per_s"; empty: the key names no unit
  double divisor = 1.0;
  double multiplier = 1.0;
  bool decibel = false;
};

/// An SI value in the unit; not a number for the decibels of a negative factor.
double in_unit(double value, const KeyUnit& unit);
/// The same unit of a number whose own key does not name it.
KeyUnit without_suffix(const KeyUnit& unit);
/// "rate" in mdeg/s: "rate_mdeg_per_s".
std::string key_with_unit(std::string_view key, const KeyUnit& unit);

namespace key_units {

inline constexpr double millidegree_in_radians = std::numbers::pi / 180e3;

/// Of a key whose text, or that of the key around it, names the unit.
inline constexpr KeyUnit none{};
inline constexpr KeyUnit ratio{.suffix = "1"};
inline constexpr KeyUnit second{.suffix = "s"};
inline constexpr KeyUnit per_second{.suffix = "per_s"};
/// Of frequencies kept in Hz, and of those kept in rad/s.
inline constexpr KeyUnit hertz{.suffix = "Hz"};
inline constexpr KeyUnit hertz_of_radians{.suffix = "Hz", .divisor = two_pi};
inline constexpr KeyUnit radian_per_second{.suffix = "rad_per_s"};
inline constexpr KeyUnit degree{.suffix = "deg", .divisor = std::numbers::pi / 180.0};
/// Of angles kept in degrees.
inline constexpr KeyUnit degree_as_kept{.suffix = "deg"};
inline constexpr KeyUnit millidegree{.suffix = "mdeg", .divisor = millidegree_in_radians};
inline constexpr KeyUnit millidegree_per_second{.suffix = "mdeg_per_s",
                                                .divisor = millidegree_in_radians};
inline constexpr KeyUnit newton_metre{.suffix = "N_m"};
inline constexpr KeyUnit metre_per_second{.suffix = "m_per_s"};
inline constexpr KeyUnit pascal{.suffix = "Pa"};
/// Of factors.
inline constexpr KeyUnit decibel{.suffix = "dB", .decibel = true};
/// Of levels kept in dB.
inline constexpr KeyUnit decibel_as_kept{.suffix = "dB"};

}  // namespace key_units
}  // namespace boresight::io
