#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <boresight/design/audit/source_reading.hpp>

namespace boresight::design {

/// A printed form that departs from what it would be, as the explanations need it.
struct Departure {
  std::size_t node = 0;
  Print print;
  double would_be = 0.0;
  double tolerance = 0.0;
  /// How it was recomputed; empty where nothing was (a conversion, a restated input).
  Reading reading;
  /// Which forms of the same statement follow and so can have been converted into this one.
  std::vector<std::size_t> sound_forms;
};

/// One slip of the pen or of the typesetter: a power of ten, two neighbouring digits swapped, a
/// digit cut off, changed or lost, or the other column converted with a rounded factor. Digits are
/// put right only where the tolerance is too narrow for chance to do it.
std::vector<std::string> explain_as_misprint(const AuditGraph& graph, const Departure& departure);

/// One slip of the author: a parent rounded to two or three digits, taken from another column or
/// statement, several parents taken as they should have been printed (`corrected`), or the number
/// of another quantity.
std::vector<std::string> explain_as_slip(const AuditGraph& graph, const Departure& departure,
                                         const AuditGraph::Values& corrected);

/// What single ancestors would have to be, the smallest changes first, at most two; for a number
/// that nothing else explains.
std::vector<std::string> ancestors_needed(const AuditGraph& graph, const Departure& departure);

/// Departures that one value of a shared ancestor would put right together.
struct CommonCause {
  std::size_t ancestor = 0;
  double value = 0.0;
  std::vector<std::size_t> departures;  // indices into the list given
};

/// For each ancestor the largest group of at least three quantities whose departures, each within
/// its rounding, one value of it explains.
std::vector<CommonCause> common_causes(const AuditGraph& graph,
                                       const std::vector<Departure>& departures);

}  // namespace boresight::design
