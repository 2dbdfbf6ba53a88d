#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <boresight/design/audit/printed_number.hpp>

namespace boresight::design {

/// One place where a source prints a quantity, in one or more parallel columns.
struct Statement {
  std::vector<PrintedForm> forms;
  std::string source;
};

/// A quantity of the source: an input, or derived from others by a formula over SI values.
struct AuditNode {
  std::string id;
  std::string description;
  std::string unit;  // SI, for the report
  /// Ids of the quantities that the formula takes, in its order; empty for an input.
  std::vector<std::string> parents;
  /// Computes the value from the parents' values. Empty for an input. May throw InvalidInput where
  /// it has no value.
  std::function<double(std::span<const double>)> formula;
  /// Where it is printed; an input's value is its first statement.
  std::vector<Statement> statements;
  /// A headline result: consequences of findings are expressed in terms of these.
  bool headline = false;
};

/// Quantities and their dependences.
class AuditGraph {
 public:
  using Values = std::map<std::size_t, double>;

  /// The nodes may be in any order.
  /// @throws InvalidInput for a duplicate id, an unknown parent, a quantity that derives from
  /// itself, an input without a statement, or a statement without a form.
  explicit AuditGraph(std::vector<AuditNode> nodes);

  const std::vector<AuditNode>& nodes() const { return nodes_; }
  const AuditNode& node(std::size_t index) const { return nodes_[index]; }
  bool is_input(std::size_t index) const { return !nodes_[index].formula; }
  /// @throws InvalidInput for an unknown id.
  std::size_t index(const std::string& id) const;

  /// The nearest ancestors that are printed (inputs always are), from which a reader of the source
  /// would compute the node.
  const std::vector<std::size_t>& stated_ancestors(std::size_t index) const {
    return stated_ancestors_[index];
  }
  /// True if `ancestor` enters the node's formula, directly or through others.
  bool descends_from(std::size_t index, std::size_t ancestor) const;

  /// Evaluates the node's formula on the given values. Quantities without a given value are derived
  /// in turn; inputs are taken as first printed. A given value of the node itself is ignored.
  double derive(std::size_t index, const Values& values) const;
  /// The given value, else the input's, else the derived one.
  double value(std::size_t index, const Values& values) const;

  /// The columns of the forms, ascending; {-1} if there are none.
  const std::vector<int>& columns() const { return columns_; }

 private:
  void link_parents();
  void order_parents_first();
  void collect_stated_ancestors();

  std::vector<AuditNode> nodes_;
  std::vector<std::vector<std::size_t>> parents_;
  std::vector<std::size_t> order_;
  std::vector<std::vector<std::size_t>> stated_ancestors_;
  std::vector<int> columns_;
};

}  // namespace boresight::design
