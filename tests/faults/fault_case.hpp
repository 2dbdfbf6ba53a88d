#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recorder_fault.hpp"
#include <boresight/identification/grey_box/stated_number_check.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::faults {

/// What identify makes of a campaign with a fault.
enum class Outcome {
  right,          // recommended, within 2 % of the truth and in its interval
  uncovered,      // recommended, within 2 %, the truth outside the interval
  flagged,        // nothing recommended, a faulty channel or record named
  refused,        // nothing recommended, nothing named
  other_flagged,  // nothing recommended, only others named
  warned,         // recommended and further off, a faulty channel or record named
  held,           // recommended and further off, nothing faulty named, the truth in its interval
  undetectable,   // the same, the truth outside; an error that these records do not show, and
                  // identify says so: the interval without the stated number holds the truth
  silently_wrong  // the same, without that
};
inline constexpr std::size_t outcomes = 9;
/// "right", "not covered", "flagged", "refused", "other flagged", "warned", "wide", "undetectable",
/// "silently wrong".
std::string_view to_string(Outcome outcome);

/// A campaign before any fault.
struct Recorded {
  std::uint64_t number = 0;
  RecordedCampaign campaign;
  double inertia = 0.0;  // the truth, kg m2
  /// Findings about the data without a fault, which name nothing.
  std::vector<std::string> findings;
};

/// One fault on one campaign.
struct FaultCase {
  std::string kind;
  std::string fault;
  std::uint64_t campaign = 0;
  Outcome outcome = Outcome::refused;
  bool named = false;                         // a faulty channel or record is named
  std::optional<numerics::Interval> inertia;  // the fit's, recommended or not
  double error = 0.0;                         // of the fit's inertia, relative
  /// Of the stated number that the fault puts in error (RecorderFault::stated_number).
  std::optional<identification::StatedNumberCheck> check;
  bool without_holds = false;  // the inertia's interval without that number holds the truth
  double conflict = 0.0;       // of the fit with stated numbers, sum of squares over its limit
  double departure = 0.0;      // the largest of a stated number that moves the inertia
  std::string rejection;       // why nothing is recommended; empty if something is
  std::vector<std::string> findings;  // the first three about the data
};

/// The setting of identify that faults are measured with: everything as the program's but this.
struct FaultSetting {
  int further_starts = 0;
  int random_samples = 400;
};

/// Campaign `number` of a seed, as tests/coverage simulates it but with three constant speeds and
/// shorter tests, four minutes in all. @throws NumericalFailure
Recorded recorded_campaign(std::uint64_t seed, std::uint64_t number, const FaultSetting& setting);

/// Identifies the campaign with the fault as `boresight identify` does, by one thread. Where
/// channels contradict one another nothing is recommended whatever fits, and nothing is fitted.
/// The result depends on seed, campaign and fault alone.
FaultCase fault_case(const RecorderFault& fault, const Recorded& recorded, std::uint64_t seed,
                     const FaultSetting& setting);

}  // namespace boresight::faults
