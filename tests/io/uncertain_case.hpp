#pragma once

#include <string>

#include "io/edited_case.hpp"

namespace boresight::io {

/// The 70-m antenna with uncertainties of the locked rotor and of leakage, and another [ensemble].
inline Case uncertain_case(const std::string& of_rotor, const std::string& of_leakage,
                           const std::string& ensemble = "") {
  EditedCase edited;
  edited.replace(
      "\nlocked_rotor_frequency = { value = \"2.0 Hz\"",
      "\nlocked_rotor_frequency = { value = \"2.0 Hz\", uncertainty = \"" + of_rotor + "\"");
  edited.replace("\nleakage_rate = { value = \"1.219 1/s\"",
                 "\nleakage_rate = { value = \"1.219 1/s\", uncertainty = \"" + of_leakage + "\"");
  return parse_case(edited.text() + "\n" + ensemble, "case.toml");
}

}  // namespace boresight::io
