#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <boresight/design/audit/source_reading.hpp>

namespace boresight::design {

/// A printed form that departs from its expected value, with the data for explanations.
struct Departure {
  std::size_t node = 0;
  Print print;
  double would_be = 0.0;
  double tolerance = 0.0;
  /// How it was recomputed; empty where it was not (a conversion, a restated input).
  Reading reading;
  /// Consistent forms of the same statement, from which this one may have been converted.
  std::vector<std::size_t> sound_forms;
};

/// Explains a departure by one misprint: a power of ten, two neighbouring digits swapped, a digit
/// truncated, changed or lost, or the other column converted with a rounded factor. Digits are
/// corrected only where the tolerance is narrow enough to exclude a coincidence.
std::vector<std::string> explain_as_misprint(const AuditGraph& graph, const Departure& departure);

/// Explains a departure by one slip of the author: a parent rounded to two or three digits, or
/// taken from another column or statement. Or: several parents taken as they should have been
/// printed (`corrected`), or the number of another quantity.
std::vector<std::string> explain_as_slip(const AuditGraph& graph, const Departure& departure,
                                         const AuditGraph::Values& corrected);

/// Required values of single ancestors, the smallest changes first, at most two; for a number
/// without another explanation.
std::vector<std::string> ancestors_needed(const AuditGraph& graph, const Departure& departure);

/// Departures that one value of a common ancestor would correct together.
struct CommonCause {
  std::size_t ancestor = 0;
  double value = 0.0;
  std::vector<std::size_t> departures;  // indices into the list given
};

/// For each ancestor, the largest group of at least three quantities whose departures one value of
/// it explains, each within its rounding.
std::vector<CommonCause> common_causes(const AuditGraph& graph,
                                       const std::vector<Departure>& departures);

}  // namespace boresight::design
