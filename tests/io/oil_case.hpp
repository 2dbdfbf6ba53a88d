#pragma once

#include <string>

#include <fmt/format.h>

#include "io/edited_case.hpp"

namespace boresight::io {

/// The 70-m antenna, its leakage by a flow, with a bulk modulus (Pa) and a measured frequency.
inline Case with_oil(double bulk_modulus, const std::string& measured = "0.97 Hz") {
  return parse_case(
      EditedCase()
          .replace("value = \"1229 MPa\"", fmt::format("value = \"{:.17g} Pa\"", bulk_modulus))
          .replace("frequency = { value = \"0.97 Hz\"",
                   fmt::format("frequency = {{ value = \"{}\"", measured))
          .replace_line("leakage_rate = ",
                        "leakage_flow = \"6 L/min\"\nleakage_pressure = \"10 MPa\"")
          .text(),
      "case.toml");
}

}  // namespace boresight::io
