#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "fault_case.hpp"

namespace boresight::faults {

/// All campaigns of one fault.
struct FaultRow {
  std::string kind;
  std::string fault;
  std::array<std::size_t, outcomes> count{};  // by Outcome
  std::size_t campaigns = 0;
  double largest_error = 0.0;  // of what was recommended, relative, absolute
  std::size_t of(Outcome outcome) const { return count[static_cast<std::size_t>(outcome)]; }
};

/// In the order of the cases, which stand together by fault.
std::vector<FaultRow> fault_rows(const std::vector<FaultCase>& cases);

/// Table of the rows, with the sum of all.
std::string fault_markdown(const std::vector<FaultCase>& cases);

/// One line a case, CSV.
std::string fault_details(const std::vector<FaultCase>& cases);

}  // namespace boresight::faults
