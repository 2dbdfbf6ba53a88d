#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/audit/case_graph.hpp>

namespace boresight::app {

AuditReport audit(const io::Case& antenna) {
  const design::AuditGraph graph = case_graph(antenna);
  AuditReport report;
  report.title = antenna.title;
  report.findings = design::find_misprints(graph);
  report.implausible = implausibilities(antenna, graph);
  report.remarks = antenna.remarks;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const auto& statements = graph.node(i).statements;
    const std::size_t before = report.checked;
    for (std::size_t s = 0; s < statements.size(); ++s) {
      const std::size_t forms = statements[s].forms.size();
      // The first print of an input has nothing to be compared with but its other columns.
      report.checked += graph.is_input(i) && s == 0 ? forms - 1 : forms;
    }
    if (report.checked > before) report.compared.push_back(graph.node(i).id);
  }
  return report;
}

std::string failing_checks(const std::vector<Implausibility>& implausible) {
  if (implausible.empty()) return "no physical check fails";
  std::vector<std::pair<std::string, int>> counts;
  for (const Implausibility& one : implausible) {
    const auto known = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == one.check; });
    if (known == counts.end()) {
      counts.emplace_back(one.check, 1);
    } else {
      ++known->second;
    }
  }
  std::vector<std::string> subjects;
  for (const auto& [check, count] : counts) {
    subjects.push_back(count == 1 ? check : fmt::format("{} ({})", check, count));
  }
  return fmt::format("{}: {}",
                     implausible.size() == 1
                         ? "1 physical check fails"
                         : fmt::format("{} physical checks fail", implausible.size()),
                     fmt::join(subjects, ", "));
}

}  // namespace boresight::app
