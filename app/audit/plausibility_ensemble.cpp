#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/io/case/member_ranges.hpp>

namespace boresight::app {

void check_ensemble_ranges(const CaseNumbers& numbers, Implausibilities& found) {
  const io::Case& antenna = numbers.antenna;
  const io::EnsembleEntry& ensemble = antenna.ensemble;
  const design::MemberRanges ranges = member_ranges(antenna);
  const design::MemberRanges spread = spread_of_stated(antenna);
  const double leakage = antenna.drive.leakage_rate.value;
  std::vector<std::string> narrow;
  std::string first;
  std::vector<NamedNumber> ends;
  const auto check = [&](const std::optional<io::RangeEntry>& stated, const char* key,
                         const char* number, const design::Ends& range, const design::Ends& least,
                         double scale) {
    if (!stated || (range.lower <= least.lower && range.upper >= least.upper)) return;
    if (narrow.empty()) first = fmt::format("ensemble.{}", key);
    narrow.push_back(
        fmt::format("ensemble.{} of {:.3g} to {:.3g} times the number, where the "
                    "uncertainty of {} leaves {:.3g} to {:.3g}",
                    key, range.lower / scale, range.upper / scale, number, least.lower / scale,
                    least.upper / scale));
    ends.push_back({fmt::format("{} lower", key), range.lower / scale, "1"});
    ends.push_back({fmt::format("{} upper", key), range.upper / scale, "1"});
  };
  check(ensemble.structure_frequency, "structure_frequency",
        antenna.structure.locked_rotor_frequency.key.c_str(), ranges.structure_frequency,
        spread.structure_frequency, 1.0);
  check(ensemble.oil_stiffness, "oil_stiffness", "oil.bulk_modulus", ranges.oil_stiffness,
        spread.oil_stiffness, 1.0);
  check(ensemble.leakage_rate, "leakage_rate", "drive.leakage_rate", ranges.leakage_rate,
        spread.leakage_rate, leakage);
  if (narrow.empty()) return;
  found.push_back({"ensemble range", first,
                   fmt::format("[ensemble] is narrower than the case's own uncertainties (1 -+ "
                               "sqrt(3) u): {}; shares of plants and robust designs leave out "
                               "antennas that the case holds possible.",
                               fmt::join(narrow, "; ")),
                   std::move(ends)});
}

}  // namespace boresight::app
