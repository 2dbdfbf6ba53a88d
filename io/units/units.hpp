#pragma once

#include <string>
#include <string_view>

#include <boresight/numerics/error.hpp>

namespace boresight::io {

/// Exponents of the base dimensions. Angle is a dimension of its own, so that 1 Hz (a cycle a
/// second) is never taken for 1 rad/s or 1/s.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;
  int current = 0;
  int level = 0;  // decibel: a logarithm is neither number nor angle
  bool operator==(const Dimension&) const = default;
};

/// A unit as SI factor and dimension; the SI unit of angle is the radian.
struct Unit {
  double factor = 1.0;
  Dimension dimension;
};

/// Error for a unit or quantity text that is invalid or ambiguous. The message reads
///   expected WHAT, found 'TOKEN' in 'TEXT' (REMEDY)
/// and `column` is the start of the token: characters, not bytes, from 1 within the whole text
/// (number included).
class UnitError : public InvalidInput {
 public:
  UnitError(const std::string& message, int column_) : InvalidInput(message), column(column_) {}
  int column;
};

/// Reads a unit such as "lbf.ft.s2", "in3/rev", "N.m/(rad/s)", "deg/s", "%" or "1".
///
/// Grammar: names and parentheses joined by a product ('.', '*', '·' or a blank) or by '/';
/// an exponent from 1 to 9, or its negative, follows its name or parenthesis directly ("s2",
/// "s^2", "s-1", "s^-1", "s²", "s⁻¹"). Names are case sensitive and from a closed list;
/// SI prefixes only where a unit takes them, micro as 'u' or the Greek letter. Every factor is
/// exact by definition (in = 0.0254 m, lbm = 0.45359237 kg, lbf = lbm x 9.80665 m/s2, ...) and
/// rounded once.
/// Refused with the right name suggested: "gal", "oz", "lb", "mph", "psig" and their like, "J" (has
/// torque's dimension), '-' as a product ("lb-ft"), a product behind a division without parentheses
/// ("N.m/rad.s"), a second division ("a/b/c"), unknown names (with the nearest known one).
/// @throws UnitError
Unit parse_unit(std::string_view text);

/// What a field of a case file measures. Each kind fixes the dimension (angle included) and
/// thereby the SI unit the program works in.
enum class Kind {
  number,                // 1, also "%"
  length,                // m
  area,                  // m2
  volume,                // m3
  mass,                  // kg
  time,                  // s
  angle,                 // rad
  angular_rate,          // rad/s
  angular_acceleration,  // rad/s2
  frequency,             // Hz (cycles): "0.97 Hz", "6.09 rad/s", "1/s" refused
  rate_constant,         // 1/s: exponential decay, no angle: "1.219 1/s"; Hz refused
  speed,                 // m/s
  density,               // kg/m3
  inertia,               // kg m2
  torque,                // N m
  force,                 // N
  pressure,              // Pa
  power,                 // W
  flow,                  // m3/s
  displacement,          // m3/rad of a pump or motor: "2.339 in3/rev"
  stiffness,             // N m/rad
  viscous_friction,      // N m s/rad: "5.21 N.m/rpm"
  compliance,            // rad/(N m)
  voltage,               // V
  current,               // A
  tachometer_scale,      // rad/(s V): "600/157 rpm/V" is written as its value, e.g. "3.82166 rpm/V"
  rate_per_current,      // rad/(s A): a valve driven by a current
  rate_per_torque,       // rad/(s N m): torque or pressure fed back to a valve
  proportional_gain,     // 1/s of a position loop: rad/s per rad; also "1/s"
  bandwidth_frequency,   // rad/s of a compensator corner: takes rad/s and Hz alike
  level,                 // dB: a loss or gain
};

/// The name a message uses ("inertia"), the unit of the values ("kg.m2"; "Hz" for a frequency),
/// examples ("kg.m2, lbf.ft.s2").
struct KindDescription {
  std::string_view name;
  std::string_view si_unit;
  std::string_view examples;
};
const KindDescription& describe(Kind kind);

/// The unit that a message proposes for a number without one, the first of the examples; nothing
/// for a plain number.
std::string_view usual_unit(Kind kind);

/// What a message expects: "an inertia (such as kg.m2, lbf.ft.s2)".
std::string expectation(Kind kind);

/// A number with unit as printed: SI value and half a unit of its last printed digit (SI).
struct PrintedNumber {
  double value = 0.0;
  double half_unit = 0.0;
  /// As written, without surrounding blanks.
  std::string text;
};

/// Reads "0.22177 lbf.ft.s2": number, blank, unit. The blank may be missing ("5%", "0.97Hz"); the
/// unit too, for Kind::number only. The number is decimal with a point, in any locale; separators,
/// hexadecimal, ".5", "5.", infinities and NaN are refused.
/// Frequencies come out in Hz (cycles a second), every other kind in its SI unit. The half unit
/// comes from the decimals (and exponent) of the number as written: "2.41667e8" has 0.000005e8,
/// "24" has 0.5.
/// @throws UnitError naming what was expected of this kind and what was found (unknown unit,
/// wrong dimension, not a number, not finite).
PrintedNumber parse_quantity(std::string_view text, Kind kind);

}  // namespace boresight::io
