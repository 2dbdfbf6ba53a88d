#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::coverage {

/// A number of a campaign by one method, beside the truth.
struct Evaluated {
  std::string quantity;
  std::string method;
  double truth = 0.0;
  std::optional<numerics::Interval> interval;  // nothing: the method gave none
};

/// One campaign: always the same rows in the same order.
struct CoverageCase {
  std::uint64_t seed = 0;
  std::uint64_t number = 0;  // of the seed's
  std::vector<Evaluated> rows;
  std::vector<std::string> failures;  // methods that gave nothing, and why
  double largest_departure = 0.0;     // of StatedNumberCheck, of all
};

/// The setting of identify that coverage is measured with: everything as the program's but this.
struct CoverageSetting {
  int further_starts = 0;
  int random_samples = 400;  // of every Monte Carlo
};

/// Simulates campaign `number` of a seed and identifies it, by one thread.
CoverageCase coverage_case(std::uint64_t seed, std::uint64_t number,
                           const CoverageSetting& setting);

}  // namespace boresight::coverage
