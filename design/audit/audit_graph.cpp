#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

AuditGraph::AuditGraph(std::vector<AuditNode> nodes) : nodes_(std::move(nodes)) {
  std::set<int> columns;
  for (const AuditNode& node : nodes_) {
    if (!node.formula && node.statements.empty()) {
      throw InvalidInput(
          fmt::format("AuditGraph: expected a value of the input '{}', found none", node.id));
    }
    for (const Statement& statement : node.statements) {
      if (statement.forms.empty()) {
        throw InvalidInput(fmt::format(
            "AuditGraph: expected a number in each statement of '{}', found none", node.id));
      }
      for (const PrintedForm& form : statement.forms) {
        if (form.column >= 0) columns.insert(form.column);
      }
    }
  }
  columns_.assign(columns.begin(), columns.end());
  if (columns_.empty()) columns_.push_back(-1);
  link_parents();
  order_parents_first();
  collect_stated_ancestors();
}

void AuditGraph::link_parents() {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!places.emplace(nodes_[i].id, i).second) {
      throw InvalidInput(
          fmt::format("AuditGraph: expected each id once, found '{}' again", nodes_[i].id));
    }
  }
  parents_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (const std::string& parent : nodes_[i].parents) {
      const auto place = places.find(parent);
      if (place == places.end()) {
        throw InvalidInput(fmt::format("AuditGraph: expected the parent '{}' of '{}', found none",
                                       parent, nodes_[i].id));
      }
      parents_[i].push_back(place->second);
    }
  }
}

void AuditGraph::order_parents_first() {
  std::vector<bool> placed(nodes_.size(), false);
  while (order_.size() < nodes_.size()) {
    const std::size_t before = order_.size();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const bool ready = std::all_of(parents_[i].begin(), parents_[i].end(),
                                     [&](std::size_t parent) { return placed[parent]; });
      if (placed[i] || !ready) continue;
      placed[i] = true;
      order_.push_back(i);
    }
    if (order_.size() == before) {
      const auto left = std::find(placed.begin(), placed.end(), false) - placed.begin();
      throw InvalidInput(fmt::format("AuditGraph: expected no circle, found '{}' in one",
                                     nodes_[static_cast<std::size_t>(left)].id));
    }
  }
}

void AuditGraph::collect_stated_ancestors() {
  stated_ancestors_.resize(nodes_.size());
  for (const std::size_t i : order_) {
    std::vector<std::size_t>& ancestors = stated_ancestors_[i];
    const auto add = [&](std::size_t ancestor) {
      if (std::find(ancestors.begin(), ancestors.end(), ancestor) == ancestors.end()) {
        ancestors.push_back(ancestor);
      }
    };
    for (const std::size_t parent : parents_[i]) {
      if (!nodes_[parent].statements.empty()) {
        add(parent);
      } else {
        for (const std::size_t ancestor : stated_ancestors_[parent]) add(ancestor);
      }
    }
  }
}

std::size_t AuditGraph::index(const std::string& id) const {
  const auto place = std::find_if(nodes_.begin(), nodes_.end(),
                                  [&](const AuditNode& node) { return node.id == id; });
  if (place == nodes_.end()) {
    throw InvalidInput(fmt::format("AuditGraph: expected a known id, found '{}'", id));
  }
  return static_cast<std::size_t>(place - nodes_.begin());
}

bool AuditGraph::descends_from(std::size_t index, std::size_t ancestor) const {
  return std::any_of(parents_[index].begin(), parents_[index].end(), [&](std::size_t parent) {
    return parent == ancestor || descends_from(parent, ancestor);
  });
}

double AuditGraph::derive(std::size_t index, const Values& values) const {
  std::vector<double> arguments;
  arguments.reserve(parents_[index].size());
  for (const std::size_t parent : parents_[index]) arguments.push_back(value(parent, values));
  return nodes_[index].formula(arguments);
}

double AuditGraph::value(std::size_t index, const Values& values) const {
  const auto given = values.find(index);
  if (given != values.end()) return given->second;
  if (is_input(index)) return nodes_[index].statements.front().forms.front().value;
  return derive(index, values);
}

}  // namespace boresight::design
