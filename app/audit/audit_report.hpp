#pragma once

#include <string>
#include <vector>

#include <boresight/app/audit/plausibility.hpp>
#include <boresight/design/audit/misprint_search.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// What an audit of a case found.
struct AuditReport {
  std::string title;
  std::vector<design::Finding> findings;
  std::vector<Implausibility> implausible;
  /// The case writer's own, what no recomputation can find.
  std::vector<io::RemarkEntry> remarks;
  /// Printed numbers that were compared with something.
  std::size_t checked = 0;
  /// The quantities that they are of, by id, each once.
  std::vector<std::string> compared;
};

/// Recomputes every derived number the case prints and checks its inputs for plausibility. A case
/// that [[stated]] ids name quantities it has no means to recompute is not refused: they are left
/// out.
/// @throws InvalidInput if two parts of the case bear the same name.
AuditReport audit(const io::Case& antenna);

/// How many physical checks fail and what they look at: "3 physical checks fail: wave speed (2),
/// recorder limit".
std::string failing_checks(const std::vector<Implausibility>& implausible);

}  // namespace boresight::app
