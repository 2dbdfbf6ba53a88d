#include <algorithm>
#include <cmath>

#include <boresight/design/audit/source_reading.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

// Half units add up to printed differences only to within the binary rounding of decimals.
constexpr double decimal_slack = 1e-9;

double slope(const AuditGraph& graph, std::size_t node, AuditGraph::Values values,
             std::size_t ancestor) {
  const double centre = values.at(ancestor);
  const double step = centre == 0.0 ? 1e-9 : 1e-6 * std::abs(centre);
  values[ancestor] = centre + step;
  const double above = graph.derive(node, values);
  values[ancestor] = centre - step;
  return (above - graph.derive(node, values)) / (2.0 * step);
}

}  // namespace

const PrintedForm& print_of(const AuditGraph& graph, std::size_t node, Print print) {
  return graph.node(node).statements[print.statement].forms[print.form];
}

bool columns_conflict(const PrintedForm& a, const PrintedForm& b) {
  return std::abs(a.value - b.value) >
         (a.half_unit + b.half_unit) * (1.0 + decimal_slack) + decimal_slack * std::abs(a.value);
}

double hidden_rounding(const Statement& statement, std::size_t form) {
  const PrintedForm& own = statement.forms[form];
  double rounding = own.half_unit;
  for (const PrintedForm& other : statement.forms) {
    if (&other == &own || columns_conflict(own, other)) continue;
    const double difference = std::abs(own.value - other.value);
    const double coarse = std::max(own.half_unit, other.half_unit);
    const double fine = std::min(own.half_unit, other.half_unit);
    if (difference <= decimal_slack * std::abs(own.value) && coarse >= 10.0 * fine) return 0.0;
    rounding = std::min(rounding, other.half_unit + difference);
  }
  return rounding;
}

Reading reading_in_column(const AuditGraph& graph, std::size_t node, int column) {
  Reading reading;
  for (const std::size_t ancestor : graph.stated_ancestors(node)) {
    const auto& forms = graph.node(ancestor).statements.front().forms;
    const auto place = std::find_if(forms.begin(), forms.end(),
                                    [&](const PrintedForm& form) { return form.column == column; });
    reading[ancestor] = {
        0, place == forms.end() ? 0 : static_cast<std::size_t>(place - forms.begin())};
  }
  return reading;
}

AuditGraph::Values values_of(const AuditGraph& graph, const Reading& reading) {
  AuditGraph::Values values;
  for (const auto& [ancestor, print] : reading) {
    values[ancestor] = print_of(graph, ancestor, print).value;
  }
  return values;
}

Recomputation recompute(const AuditGraph& graph, std::size_t node, const Reading& reading) {
  const AuditGraph::Values values = values_of(graph, reading);
  Recomputation result{graph.derive(node, values), 0.0};
  for (const auto& [ancestor, print] : reading) {
    const double hidden =
        hidden_rounding(graph.node(ancestor).statements[print.statement], print.form);
    if (hidden > 0.0) result.rounding += hidden * std::abs(slope(graph, node, values, ancestor));
  }
  return result;
}

std::optional<double> ancestor_needed(const AuditGraph& graph, std::size_t node,
                                      const Reading& reading, std::size_t ancestor, double target) {
  AuditGraph::Values values = values_of(graph, reading);
  const double printed = values.at(ancestor);
  try {
    for (int iteration = 0; iteration < 50; ++iteration) {
      const double miss = target - graph.derive(node, values);
      if (std::abs(miss) <= 1e-12 * std::abs(target)) return values[ancestor];
      const double gradient = slope(graph, node, values, ancestor);
      if (gradient == 0.0) return std::nullopt;
      values[ancestor] += miss / gradient;
      const double ratio = values[ancestor] / printed;
      if (ratio <= 0.5 || ratio >= 2.0 || std::isnan(ratio)) return std::nullopt;
    }
  } catch (const InvalidInput&) {
    return std::nullopt;  // the search left the formula's domain
  }
  return std::nullopt;
}

}  // namespace boresight::design
