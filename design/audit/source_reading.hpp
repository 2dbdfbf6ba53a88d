#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include <boresight/design/audit/audit_graph.hpp>

namespace boresight::design {

/// Which print of a quantity is taken: indices into its statements and their forms.
struct Print {
  std::size_t statement = 0;
  std::size_t form = 0;
};

/// The print a reader takes of each stated ancestor of a quantity to recompute it.
using Reading = std::map<std::size_t, Print>;

/// A recomputed value and how far the printed rounding of what it is computed from can move it:
/// the sum of |df/dp| times each parent's half unit.
struct Recomputation {
  double value = 0.0;
  double rounding = 0.0;
};

const PrintedForm& print_of(const AuditGraph& graph, std::size_t node, Print print);

/// Half a unit of what a form can hide (SI), from all columns of its statement together: a coarse
/// print is no less certain than a finer one beside it that agrees. A print that the neighbouring
/// column converts to the last digit, though its own rounding spans at least ten of the
/// neighbour's units, was exact ("5.08 cm (2 in)") and hides nothing.
double hidden_rounding(const Statement& statement, std::size_t form);

/// Whether two forms of a statement differ by more than both their half units.
bool columns_conflict(const PrintedForm& a, const PrintedForm& b);

/// For each stated ancestor its first statement in the column, or that statement's first form.
Reading reading_in_column(const AuditGraph& graph, std::size_t node, int column);

AuditGraph::Values values_of(const AuditGraph& graph, const Reading& reading);

Recomputation recompute(const AuditGraph& graph, std::size_t node, const Reading& reading);

/// The value of one ancestor that would make the node come out at `target`, the rest as read:
/// nothing if there is none between half and twice the ancestor's.
std::optional<double> ancestor_needed(const AuditGraph& graph, std::size_t node,
                                      const Reading& reading, std::size_t ancestor, double target);

}  // namespace boresight::design
