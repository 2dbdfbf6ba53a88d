#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <boresight/design/audit/misprint_explanations.hpp>
#include <boresight/design/audit/misprint_search.hpp>

namespace boresight::design {

/// A finding with the data needed to explain it.
struct FindingDraft {
  Finding finding;
  std::size_t node = 0;
  std::size_t statement = 0;
  std::vector<Departure> departures;
};

/// For a statement whose columns conflict: the column from which a derived number follows
/// (`solved`) or to which it is nearest.
struct ColumnEvidence {
  std::size_t form = 0;
  std::string id;  // of the derived number
  bool solved = false;
};
/// By node and statement.
using EvidenceByStatement =
    std::map<std::pair<std::size_t, std::size_t>, std::vector<ColumnEvidence>>;

/// Adds explanations, common causes of several findings, and the evidence for one column to the
/// findings. `corrected`: corrected value of each departing derived quantity.
void explain_drafts(const AuditGraph& graph, std::vector<FindingDraft>& drafts,
                    const AuditGraph::Values& corrected, const EvidenceByStatement& evidence);

/// Recomputes the dependent headline results with the printed and with the corrected number.
void add_derived_quantities(const AuditGraph& graph, FindingDraft& draft);

}  // namespace boresight::design
