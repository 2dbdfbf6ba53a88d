#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/design/audit/misprint_search.hpp>
#include <boresight/io/audit/physical_checks.hpp>

namespace boresight::io {

/// What an audit of a case found.
struct CaseAudit {
  std::vector<design::Finding> findings;
  PhysicalChecks physics;
  /// Printed numbers that were compared with something.
  std::size_t checked = 0;
  /// The quantities that they are of, by id, each once.
  std::vector<std::string> compared;
};

/// Recomputes every derived number the case prints (case_graph, design::find_misprints) and checks
/// its inputs for plausibility (check_physics). A case that [[stated]] ids name quantities it has
/// no means to recompute is not refused: they are left out.
/// @throws InvalidInput if two parts of the case bear the same name, and as check_physics.
CaseAudit audit(const Case& antenna);

}  // namespace boresight::io
