#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/identify/first_tests.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_simulation.hpp>

namespace boresight::app {
namespace {

bool measured(const io::Quantity& quantity) {
  return quantity.basis == io::Basis::measured;
}

// Keys of the friction curve's numbers that nobody measured; a rate is none where the part that it
// belongs to is zero.
std::vector<std::string> unmeasured_friction(const io::FrictionCurveEntry& curve) {
  std::vector<std::string> keys;
  const auto add = [&](const char* key, const io::Quantity& quantity, bool counts = true) {
    if (counts && !measured(quantity)) keys.emplace_back(key);
  };
  add("coulomb", curve.coulomb);
  add("breakaway", curve.breakaway);
  add("stribeck_rate", curve.stribeck_rate, curve.breakaway.value > curve.coulomb.value);
  add("saturating", curve.saturating);
  add("saturating_rate", curve.saturating_rate, curve.saturating.value > 0.0);
  add("viscous", curve.viscous);
  return keys;
}

bool nothing_measured(const io::FrictionCurveEntry& curve) {
  const auto all = {&curve.coulomb,    &curve.breakaway,       &curve.stribeck_rate,
                    &curve.saturating, &curve.saturating_rate, &curve.viscous};
  return std::none_of(all.begin(), all.end(),
                      [](const io::Quantity* quantity) { return measured(*quantity); });
}

std::string shown_friction(const io::FrictionCurveEntry& curve) {
  if (nothing_measured(curve)) {
    return "they give the friction curve, so far not measured";
  }
  const auto keys = unmeasured_friction(curve);
  if (keys.empty()) return "they check the measured friction curve";
  return fmt::format(
      "they give the parts of the friction curve not yet measured ({}) and check the rest",
      fmt::join(keys, ", "));
}

std::string how_to_practise(const io::Case& antenna) {
  std::vector<std::string> missing;
  if (!antenna.simulation) missing.emplace_back("[simulation]");
  if (!antenna.recorder) missing.emplace_back("[recorder]");
  if (!antenna.campaign->tachometer) missing.emplace_back("[tachometer]");
  if (antenna.campaign->lines.empty()) missing.emplace_back("[[oil.line]]");
  return fmt::format(
      "`boresight simulate {} valve-steps slow-ramp constant-speed` simulates such records to try "
      "out their evaluation{}. Name your records by [[record]]; docs/records.md lists the accepted "
      "formats.",
      antenna.path,
      missing.empty() ? "" : fmt::format(" (the case lacks {})", fmt::join(missing, ", ")));
}

}  // namespace

std::vector<std::string> first_tests(const io::Case& antenna) {
  const bool modulus_known = antenna.oil->bulk_modulus && measured(*antenna.oil->bulk_modulus);
  std::vector<std::string> sentences{
      "The case has no records: these results rest on the values that it states.",
      "First record small valve steps about a constant speed and a valve sweep (valve-steps, "
      "valve-chirp), with all pressures, tachometer and valve command. They identify inertia, oil "
      "stiffness and leakage (docs/identification.md)."};
  sentences.push_back(
      fmt::format("Then record a slow ramp and constant speeds in both directions, some below the "
                  "rate at which friction levels off: {}.",
                  shown_friction(*antenna.friction_curve)));
  if (!modulus_known && antenna.oil->lines.empty()) {
    sentences.emplace_back(
        "A slosh test with a transducer at the motor end of each line measures the oil's bulk "
        "modulus.");
  }
  sentences.push_back(how_to_practise(antenna));
  return sentences;
}

}  // namespace boresight::app
