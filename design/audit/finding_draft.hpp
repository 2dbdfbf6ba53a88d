#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <boresight/design/audit/misprint_explanations.hpp>
#include <boresight/design/audit/misprint_search.hpp>

namespace boresight::design {

/// A finding with what is still needed to explain it.
struct FindingDraft {
  Finding finding;
  std::size_t node = 0;
  std::size_t statement = 0;
  std::vector<Departure> departures;
};

/// Of a statement whose columns conflict, the column that a derived number follows from
/// (`solved`) or comes nearest to.
struct ColumnEvidence {
  std::size_t form = 0;
  std::string id;  // of the derived number
  bool solved = false;
};
/// By node and statement.
using EvidenceByStatement =
    std::map<std::pair<std::size_t, std::size_t>, std::vector<ColumnEvidence>>;

/// Writes explanations, causes that several findings share, and the evidence for one column into
/// the findings. `corrected` has what each departing derived quantity would be.
void explain_drafts(const AuditGraph& graph, std::vector<FindingDraft>& drafts,
                    const AuditGraph::Values& corrected, const EvidenceByStatement& evidence);

/// Recomputes the headline results downstream with the number as printed and as it would be.
void add_consequences(const AuditGraph& graph, FindingDraft& draft);

}  // namespace boresight::design
