#pragma once

#include <string>

#include <fmt/format.h>

#include "io/edited_case.hpp"

namespace boresight::io {

/// The 70-m antenna with a measured hydraulic frequency.
inline EditedCase measured_at(const std::string& frequency) {
  EditedCase edited;
  edited.replace("frequency = { value = \"0.97 Hz\"",
                 fmt::format("frequency = {{ value = \"{}\"", frequency));
  return edited;
}

/// Its leakage stated by a flow.
inline EditedCase leaking_by_flow(EditedCase edited) {
  return edited.replace_line("leakage_rate = ",
                             "leakage_flow = \"6 L/min\"\nleakage_pressure = \"10 MPa\"");
}

/// Both, with a bulk modulus (Pa).
inline Case with_oil(double bulk_modulus, const std::string& measured = "0.97 Hz") {
  EditedCase edited = leaking_by_flow(measured_at(measured));
  edited.replace("value = \"1229 MPa\"", fmt::format("value = \"{:.17g} Pa\"", bulk_modulus));
  return parse_case(edited.text(), "case.toml");
}

}  // namespace boresight::io
