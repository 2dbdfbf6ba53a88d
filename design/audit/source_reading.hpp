#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include <boresight/design/audit/audit_graph.hpp>

namespace boresight::design {

/// The printed form used for a quantity: indices into its statements and their forms.
struct Print {
  std::size_t statement = 0;
  std::size_t form = 0;
};

/// The printed form of each stated ancestor from which a reader recomputes a quantity.
using Reading = std::map<std::size_t, Print>;

/// A recomputed value and its possible change by the printed rounding of its inputs: the sum of
/// |df/dp| times each parent's half unit.
struct Recomputation {
  double value = 0.0;
  double rounding = 0.0;
};

const PrintedForm& print_of(const AuditGraph& graph, std::size_t node, Print print);

/// Half a unit of the rounding that a form can hide (SI), from all columns of its statement
/// together. A coarse print is as certain as a finer one beside it that agrees. A form is exact if
/// the neighbouring column converts it to the last digit and its own rounding spans at least ten of
/// the neighbour's units. Such a form hides no rounding: "5.08 cm (2 in)".
double hidden_rounding(const Statement& statement, std::size_t form);

/// True if two forms of a statement differ by more than both their half units.
bool columns_conflict(const PrintedForm& a, const PrintedForm& b);

/// For each stated ancestor its first statement in the column, or that statement's first form.
Reading reading_in_column(const AuditGraph& graph, std::size_t node, int column);

AuditGraph::Values values_of(const AuditGraph& graph, const Reading& reading);

Recomputation recompute(const AuditGraph& graph, std::size_t node, const Reading& reading);

/// The value of one ancestor at which the node equals `target`, the others as read. None if there
/// is no such value between half and twice the ancestor's.
std::optional<double> ancestor_needed(const AuditGraph& graph, std::size_t node,
                                      const Reading& reading, std::size_t ancestor, double target);

}  // namespace boresight::design
