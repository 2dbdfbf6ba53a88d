#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/audit/source_reading.hpp>

namespace boresight::design {

enum class FindingKind {
  conversion,   // the columns of one statement differ by more than their rounding
  derivation,   // a derived number does not follow from its inputs
  restatement,  // an input is printed again with another value
};
std::string_view to_string(FindingKind kind);

/// One printed form that departs, and its expected value. SI.
struct DepartingForm {
  std::string text;
  double printed = 0.0;
  double would_be = 0.0;
  std::string would_be_text;
  /// Printed rounding of this number and of all numbers it is computed from.
  double tolerance = 0.0;

  /// printed / would_be - 1.
  double relative_error() const;
};

/// A headline result with the number as printed and as corrected.
struct DerivedQuantity {
  std::string id;
  std::string unit;
  double as_printed = 0.0;
  double as_corrected = 0.0;

  double relative_change() const;
};

struct Finding {
  FindingKind kind = FindingKind::derivation;
  std::string id;
  std::string description;
  std::string unit;
  std::string source;
  std::vector<DepartingForm> forms;
  /// The number departs by more than its own rounding, but the rounding of its inputs could explain
  /// it.
  bool within_parents_rounding = false;
  /// Changes that would make the number follow, each continuing "would follow": "with ...", "as
  /// ...", "if ...". Where several forms depart it begins with the form concerned: "'1.31 kg.m2'
  /// as".
  std::vector<std::string> explanations;
  /// Evidence for one column where two conflict.
  std::vector<std::string> evidence;
  /// Largest relative change first, at most three.
  std::vector<DerivedQuantity> derived_quantities;
};

/// Recomputes every printed number of the graph and returns those that do not follow:
/// - columns of a statement that differ by more than the sum of their half units;
/// - a statement of an input that departs from its value by more than both half units;
/// - a statement of a derived quantity beyond its own half unit plus the worst case of its stated
///   ancestors' rounding. Each ancestor is taken in the same column; a number without a column of
///   its own must follow in any of them. Where an ancestor is printed several times, one that
///   reproduces the number is enough.
/// Findings are in the order of the nodes; the order does not influence the findings.
std::vector<Finding> find_misprints(const AuditGraph& graph);

}  // namespace boresight::design
