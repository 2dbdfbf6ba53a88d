#include <boresight/io/audit/case_audit.hpp>
#include <boresight/io/audit/case_graph.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

CaseAudit audit(const Case& antenna) {
  const design::AuditGraph graph = case_graph(antenna);
  CaseAudit found;
  found.findings = design::find_misprints(graph);
  found.physics = check_physics(antenna, graph);
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const auto& statements = graph.node(i).statements;
    const std::size_t before = found.checked;
    for (std::size_t s = 0; s < statements.size(); ++s) {
      const std::size_t forms = statements[s].forms.size();
      // The first print of an input has nothing to be compared with but its other columns.
      found.checked += graph.is_input(i) && s == 0 ? forms - 1 : forms;
    }
    if (found.checked > before) found.compared.push_back(graph.node(i).id);
  }
  return found;
}

}  // namespace boresight::io
