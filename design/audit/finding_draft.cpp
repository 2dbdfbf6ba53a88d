#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <boresight/design/audit/finding_draft.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t max_explanations = 2;
constexpr std::size_t max_derived_quantities = 3;

class Explanation {
 public:
  Explanation(const AuditGraph& graph, std::vector<FindingDraft>& drafts,
              const AuditGraph::Values& corrected, const EvidenceByStatement& evidence)
      : graph_(graph), drafts_(drafts), corrected_(corrected), evidence_(evidence) {}

  void run() {
    std::vector<Departure> all;
    std::vector<std::size_t> owners;
    std::vector<std::vector<std::string>> needs;
    for (std::size_t d = 0; d < drafts_.size(); ++d) {
      FindingDraft& found = drafts_[d];
      set_sound_forms(found);
      auto& explanations = found.finding.explanations;
      std::vector<std::string> needed;
      for (const Departure& departure : found.departures) {
        const std::string prefix =
            found.departures.size() > 1
                ? "'" + print_of(graph_, departure.node, departure.print).text + "' "
                : "";
        auto texts = explain_as_misprint(graph_, departure);
        if (found.finding.kind == FindingKind::derivation) {
          const auto slips = slips_in_any_column(departure);
          texts.insert(texts.end(), slips.begin(), slips.end());
          if (!found.finding.within_parents_rounding) {
            if (needed.empty()) needed = ancestors_needed(graph_, departure);
            all.push_back(departure);
            owners.push_back(d);
          }
        }
        texts.resize(std::min(max_explanations, texts.size()));
        for (const std::string& text : texts) explanations.push_back(prefix + text);
      }
      needs.push_back(needed);
    }
    add_common_causes(all, owners);
    for (std::size_t d = 0; d < drafts_.size(); ++d) {
      auto& explanations = drafts_[d].finding.explanations;
      if (explanations.empty()) explanations = needs[d];
    }
    add_evidence();
  }

 private:
  std::vector<std::string> slips_in_any_column(Departure departure) const {
    auto slips = explain_as_slip(graph_, departure, corrected_);
    if (print_of(graph_, departure.node, departure.print).column >= 0) return slips;
    for (const int column : graph_.columns()) {
      if (!slips.empty()) break;
      departure.reading = reading_in_column(graph_, departure.node, column);
      slips = explain_as_slip(graph_, departure, corrected_);
    }
    return slips;
  }

  // A form that follows, alone or as far as its columns agree, may be what another was made from.
  void set_sound_forms(FindingDraft& found) const {
    const std::size_t count = graph_.node(found.node).statements[found.statement].forms.size();
    if (found.finding.kind != FindingKind::derivation) return;
    for (Departure& departure : found.departures) {
      departure.sound_forms.clear();
      for (std::size_t f = 0; f < count; ++f) {
        const bool departs =
            !found.finding.within_parents_rounding &&
            std::any_of(found.departures.begin(), found.departures.end(),
                        [&](const Departure& other) { return other.print.form == f; });
        if (!departs && f != departure.print.form) departure.sound_forms.push_back(f);
      }
    }
  }

  void add_common_causes(const std::vector<Departure>& all,
                         const std::vector<std::size_t>& owners) {
    for (const CommonCause& cause : common_causes(graph_, all)) {
      const PrintedForm& form = graph_.node(cause.ancestor).statements.front().forms.front();
      std::set<std::size_t> members;
      for (const std::size_t departure : cause.departures) members.insert(owners[departure]);
      for (const std::size_t member : members) {
        std::set<std::string> others;
        for (const std::size_t other : members) {
          if (drafts_[other].node != drafts_[member].node) others.insert(drafts_[other].finding.id);
        }
        auto& explanations = drafts_[member].finding.explanations;
        explanations.insert(explanations.begin(),
                            fmt::format("like {} if {} were {} instead of '{}'",
                                        fmt::join(others, ", "), graph_.node(cause.ancestor).id,
                                        every_column(cause.ancestor, cause.value), form.text));
      }
    }
  }

  std::string every_column(std::size_t node, double value) const {
    std::vector<std::string> texts;
    for (const PrintedForm& form : graph_.node(node).statements.front().forms) {
      texts.push_back(fmt::format("'{}'", reprint(form, value, 1)));
    }
    return fmt::format("{}", fmt::join(texts, " = "));
  }

  void add_evidence() {
    for (FindingDraft& found : drafts_) {
      if (found.finding.kind != FindingKind::conversion) continue;
      const auto known = evidence_.find({found.node, found.statement});
      if (known == evidence_.end()) continue;
      const auto& entries = known->second;
      const auto& forms = graph_.node(found.node).statements[found.statement].forms;
      for (std::size_t f = 0; f < forms.size(); ++f) {
        for (const bool solved : {true, false}) {
          std::set<std::string> ids;
          for (const ColumnEvidence& entry : entries) {
            if (entry.form == f && entry.solved == solved) ids.insert(entry.id);
          }
          if (ids.empty()) continue;
          found.finding.evidence.push_back(fmt::format(
              "with '{}' {}: {}", forms[f].text,
              solved ? "follow" : "come nearer, though not right", fmt::join(ids, ", ")));
        }
      }
    }
  }

  const AuditGraph& graph_;
  std::vector<FindingDraft>& drafts_;
  const AuditGraph::Values& corrected_;
  const EvidenceByStatement& evidence_;
};

}  // namespace

void explain_drafts(const AuditGraph& graph, std::vector<FindingDraft>& drafts,
                    const AuditGraph::Values& corrected, const EvidenceByStatement& evidence) {
  Explanation(graph, drafts, corrected, evidence).run();
}

void add_derived_quantities(const AuditGraph& graph, FindingDraft& found) {
  const DepartingForm& form = found.finding.forms.front();
  std::vector<DerivedQuantity> moved;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    if (!graph.node(i).headline || !graph.descends_from(i, found.node)) continue;
    moved.push_back({graph.node(i).id, graph.node(i).unit,
                     graph.derive(i, {{found.node, form.printed}}),
                     graph.derive(i, {{found.node, form.would_be}})});
  }
  std::stable_sort(moved.begin(), moved.end(),
                   [](const DerivedQuantity& a, const DerivedQuantity& b) {
                     return std::abs(a.relative_change()) > std::abs(b.relative_change());
                   });
  moved.resize(std::min(max_derived_quantities, moved.size()));
  found.finding.derived_quantities = std::move(moved);
}

std::string_view to_string(FindingKind kind) {
  switch (kind) {
    case FindingKind::conversion:
      return "conversion";
    case FindingKind::derivation:
      return "derivation";
    case FindingKind::restatement:
      return "restatement";
  }
  return "";
}

double DepartingForm::relative_error() const {
  return printed / would_be - 1.0;
}

double DerivedQuantity::relative_change() const {
  return as_printed / as_corrected - 1.0;
}

}  // namespace boresight::design
