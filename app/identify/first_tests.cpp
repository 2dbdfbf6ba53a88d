#include <fmt/format.h>

#include <boresight/app/identify/first_tests.hpp>

namespace boresight::app {
namespace {

bool measured(const Quantity& quantity) {
  return quantity.basis == Basis::measured;
}

std::string how_to_practise(const Case& antenna) {
  std::vector<std::string> missing;
  if (!antenna.simulation) missing.emplace_back("[simulation]");
  if (!antenna.recorder) missing.emplace_back("[recorder]");
  if (!antenna.campaign.tachometer) missing.emplace_back("[tachometer]");
  if (antenna.campaign.lines.empty()) missing.emplace_back("[[oil.line]]");
  return fmt::format(
      "`boresight simulate {} valve-steps slow-ramp constant-speed` makes such records of the "
      "nonlinear antenna, to try their evaluation on{}; docs/records.md says which files are read, "
      "and [[record]] names them.",
      antenna.path,
      missing.empty() ? ""
                      : fmt::format(" (for which the case lacks {})", fmt::join(missing, ", ")));
}

}  // namespace

std::vector<std::string> first_tests(const Case& antenna) {
  const bool friction_known =
      measured(antenna.friction_curve.coulomb) && measured(antenna.friction_curve.viscous);
  const bool modulus_known = antenna.oil.bulk_modulus && measured(*antenna.oil.bulk_modulus);
  std::vector<std::string> sentences{
      "The case has no records, so nothing here rests on the drive's motion but what the case "
      "itself states of tests.",
      "To record first: small valve steps about a constant speed, and a valve sweep (valve-steps, "
      "valve-chirp), with all pressures, the tachometer and the valve command. They can show the "
      "inertia, and with the valve command oil stiffness and leakage from motion alone "
      "(docs/identification.md)."};
  sentences.push_back(fmt::format(
      "Then a slow ramp and constant speeds, some of them below the rate at which friction levels "
      "off, both ways: {}.",
      friction_known ? "they check the friction curve, which the case has as measured"
                     : "they show the friction curve, which the case does not have as measured"));
  if (!modulus_known && antenna.oil.lines.empty()) {
    sentences.emplace_back(
        "A slosh test with a transducer at the motors' end of each line shows the oil's bulk "
        "modulus, which nothing in the case measured.");
  }
  sentences.push_back(how_to_practise(antenna));
  return sentences;
}

}  // namespace boresight::app
