#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/audit/finding_draft.hpp>
#include <boresight/design/audit/misprint_search.hpp>

namespace boresight::design {
namespace {

constexpr double decimal_slack = 1e-9;

bool follows(double printed, double recomputed, double tolerance) {
  return std::abs(printed - recomputed) <=
         tolerance * (1.0 + decimal_slack) + 1e-14 * std::abs(printed);
}

DepartingForm departing(const PrintedForm& form, double would_be, double tolerance) {
  return {form.text, form.value, would_be, reprint(form, would_be, 1), tolerance};
}

class Search {
 public:
  explicit Search(const AuditGraph& graph) : graph_(graph) {}

  std::vector<Finding> run() {
    // Conflicts between columns first: they decide which prints of a parent are in doubt.
    for (std::size_t i = 0; i < graph_.nodes().size(); ++i) check_conversions(i);
    const std::vector<FindingDraft> conversions = drafts_;
    check_statements();
    prefer_columns_that_reproduce_more();
    drafts_ = conversions;
    corrected_.clear();
    evidence_.clear();
    check_statements();
    explain_drafts(graph_, drafts_, corrected_, evidence_);
    std::stable_sort(drafts_.begin(), drafts_.end(),
                     [](const FindingDraft& a, const FindingDraft& b) {
                       return std::pair(a.finding.kind, a.node) < std::pair(b.finding.kind, b.node);
                     });
    std::vector<Finding> findings;
    for (FindingDraft& draft : drafts_) {
      add_derived_quantities(graph_, draft);
      findings.push_back(std::move(draft.finding));
    }
    return findings;
  }

 private:
  struct Variant {
    Reading reading;
    Recomputation result;
    /// The ancestors read from a column that conflicts with the statement's own.
    std::vector<std::size_t> moved;
    bool other_statement = false;
  };

  FindingDraft draft(FindingKind kind, std::size_t node, std::size_t statement) const {
    const AuditNode& quantity = graph_.node(node);
    FindingDraft result;
    result.finding.kind = kind;
    result.finding.id = quantity.id;
    result.finding.description = quantity.description;
    result.finding.unit = quantity.unit;
    result.finding.source = quantity.statements[statement].source;
    result.node = node;
    result.statement = statement;
    return result;
  }

  void check_statements() {
    for (std::size_t i = 0; i < graph_.nodes().size(); ++i) {
      for (std::size_t s = 0; s < graph_.node(i).statements.size(); ++s) {
        if (!graph_.is_input(i)) {
          check_derivation(i, s);
        } else if (s > 0) {
          check_restatement(i, s);
        }
      }
    }
  }

  // Of columns in conflict, the one that more of the derived numbers follow from or come nearer to.
  void prefer_columns_that_reproduce_more() {
    for (const auto& [place, entries] : evidence_) {
      std::map<std::size_t, int> votes;
      for (const ColumnEvidence& entry : entries) ++votes[entry.form];
      preferred_[place] = std::max_element(votes.begin(), votes.end(), [](auto a, auto b) {
                            return a.second < b.second;
                          })->first;
    }
  }

  void check_conversions(std::size_t node) {
    for (std::size_t s = 0; s < graph_.node(node).statements.size(); ++s) {
      const auto& forms = graph_.node(node).statements[s].forms;
      for (std::size_t f = 1; f < forms.size(); ++f) {
        if (!columns_conflict(forms[0], forms[f])) continue;
        conflicts_.insert({node, s});
        FindingDraft found = draft(FindingKind::conversion, node, s);
        const double tolerance = forms[0].half_unit + forms[f].half_unit;
        found.finding.forms = {departing(forms[0], forms[f].value, tolerance),
                               departing(forms[f], forms[0].value, tolerance)};
        found.departures = {{node, {s, 0}, forms[f].value, tolerance, {}, {f}},
                            {node, {s, f}, forms[0].value, tolerance, {}, {0}}};
        drafts_.push_back(std::move(found));
      }
    }
  }

  void check_restatement(std::size_t node, std::size_t statement) {
    const auto& statements = graph_.node(node).statements;
    FindingDraft found = draft(FindingKind::restatement, node, statement);
    for (std::size_t f = 0; f < statements[statement].forms.size(); ++f) {
      const PrintedForm& form = statements[statement].forms[f];
      const PrintedForm* value = &statements.front().forms.front();
      for (const PrintedForm& candidate : statements.front().forms) {
        if (candidate.column == form.column) value = &candidate;
      }
      if (!columns_conflict(form, *value)) continue;
      const double tolerance = form.half_unit + value->half_unit;
      found.finding.forms.push_back(departing(form, value->value, tolerance));
      found.departures.push_back({node, {statement, f}, value->value, tolerance, {}, {}});
    }
    if (!found.departures.empty()) drafts_.push_back(std::move(found));
  }

  // What a reader may have computed the node from: the column's prints; each other statement of an
  // ancestor; the other columns of ancestors whose columns conflict, one by one and all together.
  std::vector<Variant> variants(std::size_t node, int column) const {
    std::vector<Variant> all;
    const Reading base = reading_in_column(graph_, node, column);
    all.push_back({base, {}, {}, false});
    Variant everything{base, {}, {}, false};
    for (const auto& [ancestor, taken] : base) {
      const auto& statements = graph_.node(ancestor).statements;
      for (std::size_t s = 1; s < statements.size() && !graph_.is_input(ancestor); ++s) {
        const std::size_t f = std::min(taken.form, statements[s].forms.size() - 1);
        Variant variant{base, {}, {}, true};
        variant.reading[ancestor] = {s, f};
        all.push_back(std::move(variant));
      }
      if (!conflicts_.contains({ancestor, taken.statement})) continue;
      for (std::size_t f = 0; f < statements[taken.statement].forms.size(); ++f) {
        if (f == taken.form) continue;
        Variant variant{base, {}, {ancestor}, false};
        variant.reading[ancestor].form = f;
        all.push_back(std::move(variant));
        everything.reading[ancestor].form = f;
        everything.moved.push_back(ancestor);
      }
    }
    if (everything.moved.size() > 1) all.push_back(std::move(everything));
    for (Variant& variant : all) variant.result = recompute(graph_, node, variant.reading);
    return all;
  }

  void check_derivation(std::size_t node, std::size_t statement) {
    const auto& forms = graph_.node(node).statements[statement].forms;
    FindingDraft beyond = draft(FindingKind::derivation, node, statement);
    FindingDraft hidden = beyond;
    hidden.finding.within_parents_rounding = true;
    std::vector<std::size_t> exact;
    std::vector<std::pair<std::size_t, Variant>> inexact;
    for (std::size_t f = 0; f < forms.size(); ++f) {
      const PrintedForm& form = forms[f];
      const std::vector<int> columns =
          form.column >= 0 ? std::vector<int>{form.column} : graph_.columns();
      std::optional<Variant> nearest;
      std::optional<Variant> surest;
      bool reproduced = false;
      bool covered = false;
      for (const int column : columns) {
        for (const Variant& variant : variants(node, column)) {
          const bool sound = variant.moved.empty();
          reproduced |= sound && follows(form.value, variant.result.value, form.half_unit);
          covered |= sound && follows(form.value, variant.result.value,
                                      form.half_unit + variant.result.rounding);
          if (variant.other_statement) continue;
          if (!nearest || distance(form, variant) < distance(form, *nearest)) nearest = variant;
          if (sound && (!surest || variant.result.rounding < surest->result.rounding)) {
            surest = variant;
          }
        }
      }
      if (reproduced) {
        exact.push_back(f);
      } else if (covered && surest) {
        inexact.emplace_back(f, *surest);
      } else if (surest && nearest) {
        add_departure(beyond, f, *surest, *nearest);
      }
    }
    for (const auto& [f, variant] : inexact) {
      const bool converted = std::any_of(exact.begin(), exact.end(), [&](std::size_t other) {
        return follows(forms[f].value, forms[other].value, forms[f].half_unit);
      });
      if (converted) continue;
      add_departure_of(hidden, f, variant, forms[f].half_unit);
    }
    if (!beyond.departures.empty()) {
      const double would_be = beyond.departures.front().would_be;
      corrected_.emplace(node, would_be);
      drafts_.push_back(std::move(beyond));
    } else if (!hidden.departures.empty()) {
      drafts_.push_back(std::move(hidden));
    }
  }

  static double distance(const PrintedForm& form, const Variant& variant) {
    return std::abs(form.value - variant.result.value);
  }

  void add_departure_of(FindingDraft& found, std::size_t f, const Variant& variant,
                        double tolerance) {
    const PrintedForm& form = graph_.node(found.node).statements[found.statement].forms[f];
    found.finding.forms.push_back(departing(form, variant.result.value, tolerance));
    found.departures.push_back(
        {found.node, {found.statement, f}, variant.result.value, tolerance, variant.reading, {}});
  }

  void add_departure(FindingDraft& beyond, std::size_t f, const Variant& surest,
                     const Variant& nearest) {
    const PrintedForm& form = graph_.node(beyond.node).statements[beyond.statement].forms[f];
    const bool conflict_solves =
        follows(form.value, nearest.result.value, form.half_unit + nearest.result.rounding);
    Variant shown = surest;
    if (conflict_solves) {
      explain_by_moved_columns(beyond, form, nearest);
    } else {
      for (auto& [ancestor, print] : shown.reading) {
        const auto better = preferred_.find({ancestor, print.statement});
        if (better != preferred_.end()) print.form = better->second;
      }
      shown.result = recompute(graph_, beyond.node, shown.reading);
    }
    add_departure_of(beyond, f, shown, form.half_unit + shown.result.rounding);
    for (const auto& [ancestor, taken] : nearest.reading) {
      if (!conflicts_.contains({ancestor, taken.statement})) continue;
      evidence_[{ancestor, taken.statement}].push_back(
          {taken.form, graph_.node(beyond.node).id, conflict_solves});
    }
  }

  void explain_by_moved_columns(FindingDraft& beyond, const PrintedForm& form,
                                const Variant& nearest) const {
    std::vector<std::string> taken;
    for (const std::size_t ancestor : nearest.moved) {
      taken.push_back(fmt::format("{} '{}'", graph_.node(ancestor).id,
                                  print_of(graph_, ancestor, nearest.reading.at(ancestor)).text));
    }
    beyond.finding.explanations.push_back(
        fmt::format("'{}' with {} from the other column", form.text, fmt::join(taken, ", ")));
  }

  const AuditGraph& graph_;
  std::set<std::pair<std::size_t, std::size_t>> conflicts_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> preferred_;
  AuditGraph::Values corrected_;
  EvidenceByStatement evidence_;
  std::vector<FindingDraft> drafts_;
};

}  // namespace

std::vector<Finding> find_misprints(const AuditGraph& graph) {
  return Search(graph).run();
}

}  // namespace boresight::design
