#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <boresight/design/audit/misprint_explanations.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr double decimal_slack = 1e-9;
// An edit counts as an explanation only if it moves the number by this many tolerances, a changed
// digit only if one unit of it is this many: with a wide tolerance some edit always fits.
constexpr double edit_over_tolerance = 10.0;

bool within(double difference, double tolerance) {
  return std::abs(difference) <= tolerance * (1.0 + decimal_slack);
}

/// What a form may have been meant to be.
struct Target {
  double value;
  double tolerance;
};

// What would follow, and what the other columns of the same statement say that do follow.
std::vector<Target> targets(const AuditGraph& graph, const Departure& departure) {
  std::vector<Target> all{{departure.would_be, departure.tolerance}};
  const auto& forms = graph.node(departure.node).statements[departure.print.statement].forms;
  for (const std::size_t sound : departure.sound_forms) {
    const double half_units = forms[sound].half_unit + forms[departure.print.form].half_unit;
    all.push_back({forms[sound].value, half_units});
  }
  return all;
}

std::optional<std::string> edited_text(const std::vector<PrintedForm>& variants,
                                       const PrintedForm& form, const Target& target) {
  for (const PrintedForm& variant : variants) {
    if (within(variant.value - target.value, target.tolerance) &&
        std::abs(variant.value - form.value) >= edit_over_tolerance * target.tolerance) {
      return variant.text;
    }
  }
  return std::nullopt;
}

// Changing a digit moves the number by one to nine of its units, and the nine lie evenly.
std::optional<std::string> changed_text(const PrintedForm& form, const Target& target) {
  for (const PrintedForm& variant : changed_digits(form)) {
    const double change = std::abs(variant.value - form.value) / std::abs(unit_factor(form));
    const double unit = std::pow(10.0, std::floor(std::log10(change) + decimal_slack));
    if (within(variant.value - target.value, target.tolerance) &&
        unit * std::abs(unit_factor(form)) >=
            edit_over_tolerance * target.tolerance * (1.0 - decimal_slack)) {
      return variant.text;
    }
  }
  return std::nullopt;
}

std::optional<std::string> power_of_ten(const PrintedForm& form, const Target& target) {
  for (int size = 1; size <= 9; ++size) {
    for (const int exponent : {size, -size}) {
      const double scale = std::pow(10.0, exponent);
      const double tolerance = target.tolerance + form.half_unit * std::max(0.0, scale - 1.0);
      if (within(form.value * scale - target.value, tolerance) &&
          std::abs(target.value - form.value) >= edit_over_tolerance * tolerance) {
        return fmt::format("with a factor of {:g}", scale);
      }
    }
  }
  return std::nullopt;
}

// The unit factors' ratio as one would look it up, from exact down to three digits.
std::optional<std::string> converted_from(const PrintedForm& other, const PrintedForm& form) {
  const double exact = unit_factor(other) / unit_factor(form);
  if (exact == 1.0) return std::nullopt;
  const double number = printed_value(other);
  const double own = printed_value(form);
  const double half = form.half_unit / std::abs(unit_factor(form));
  if (within(number * exact - own, half)) {
    return fmt::format("as a conversion of the rounded '{}'", other.text);
  }
  for (int digits = 6; digits >= 3; --digits) {
    const double factor = round_to_digits(exact, digits);
    if (within(number * factor - own, half)) {
      return fmt::format("as '{}' converted with {} instead of {:.{}g}", other.text, factor, exact,
                         digits + 2);
    }
    const double divisor = round_to_digits(1.0 / exact, digits);
    if (within(number / divisor - own, half)) {
      return fmt::format("as '{}' divided by {} instead of {:.{}g}", other.text, divisor,
                         1.0 / exact, digits + 2);
    }
  }
  for (int digits = printed_digits(other) - 1; digits >= 2; --digits) {
    for (const double shortened :
         {round_to_digits(number, digits), cut_to_digits(number, digits)}) {
      if (within(shortened * exact - own, half)) {
        return fmt::format("as a conversion of '{}' shortened to {}", other.text, shortened);
      }
    }
  }
  return std::nullopt;
}

std::optional<double> derived(const AuditGraph& graph, std::size_t node,
                              const AuditGraph::Values& values) {
  try {
    return graph.derive(node, values);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

// A derivation that has pi in it, done with the pi of a slide rule.
std::optional<std::string> short_pi(const PrintedForm& form, const Departure& departure) {
  const double shortened = 3.14 / std::numbers::pi;
  if (form.half_unit > 0.5 * (1.0 - shortened) * std::abs(form.value)) return std::nullopt;
  for (const int power : {1, -1, 2, -2}) {
    if (within(departure.would_be * std::pow(shortened, power) - form.value, form.half_unit)) {
      return "with 3.14 for pi";
    }
  }
  return std::nullopt;
}

bool reproduces(const AuditGraph& graph, const Departure& departure,
                const AuditGraph::Values& values) {
  const PrintedForm& form = print_of(graph, departure.node, departure.print);
  const auto value = derived(graph, departure.node, values);
  return value && within(*value - form.value, form.half_unit);
}

void explain_by_rounded_parents(const AuditGraph& graph, const Departure& departure,
                                std::vector<std::string>& found) {
  for (const auto& [ancestor, print] : departure.reading) {
    const PrintedForm& parent = print_of(graph, ancestor, print);
    for (const int digits : {3, 2}) {
      if (digits >= printed_digits(parent)) continue;
      const double rounded = round_to_digits(printed_value(parent), digits);
      AuditGraph::Values values = values_of(graph, departure.reading);
      values[ancestor] = rounded * unit_factor(parent);
      if (values[ancestor] != parent.value && reproduces(graph, departure, values)) {
        found.push_back(fmt::format("with {} '{}' rounded to {}", graph.node(ancestor).id,
                                    parent.text, rounded));
      }
    }
  }
}

void explain_by_other_prints(const AuditGraph& graph, const Departure& departure,
                             std::vector<std::string>& found) {
  for (const auto& [ancestor, taken] : departure.reading) {
    const auto& statements = graph.node(ancestor).statements;
    for (std::size_t s = 0; s < statements.size(); ++s) {
      for (std::size_t f = 0; f < statements[s].forms.size(); ++f) {
        const PrintedForm& other = statements[s].forms[f];
        const PrintedForm& used = print_of(graph, ancestor, taken);
        if (!columns_conflict(used, other)) continue;
        Reading reading = departure.reading;
        reading[ancestor] = {s, f};
        if (reproduces(graph, departure, values_of(graph, reading))) {
          found.push_back(fmt::format("with {} '{}' instead of '{}'", graph.node(ancestor).id,
                                      other.text, used.text));
        }
      }
    }
  }
}

void explain_by_corrected_parents(const AuditGraph& graph, const Departure& departure,
                                  const AuditGraph::Values& corrected,
                                  std::vector<std::string>& found) {
  AuditGraph::Values values = values_of(graph, departure.reading);
  std::string names;
  int count = 0;
  for (const auto& [ancestor, print] : departure.reading) {
    const auto right = corrected.find(ancestor);
    if (right == corrected.end()) continue;
    values[ancestor] = right->second;
    names += (names.empty() ? "" : ", ") + graph.node(ancestor).id;
    ++count;
  }
  if (count > 0 && reproduces(graph, departure, values)) {
    found.push_back(fmt::format("with {} as {} would be", names, count == 1 ? "it" : "they"));
  }
}

void explain_by_other_quantities(const AuditGraph& graph, const Departure& departure,
                                 std::vector<std::string>& found) {
  const PrintedForm& form = print_of(graph, departure.node, departure.print);
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    if (i == departure.node || printed_digits(form) < 2) continue;
    for (const Statement& statement : graph.node(i).statements) {
      for (const PrintedForm& other : statement.forms) {
        if (other.text != form.text || form.column < 0) continue;
        found.push_back(fmt::format("as the number of {}, printed the same", graph.node(i).id));
        return;
      }
    }
  }
}

}  // namespace

std::vector<std::string> explain_as_misprint(const AuditGraph& graph, const Departure& departure) {
  const PrintedForm& form = print_of(graph, departure.node, departure.print);
  std::vector<std::string> found;
  const auto add = [&](const std::optional<std::string>& text, std::string_view wording) {
    if (text) found.push_back(fmt::format(fmt::runtime(wording), *text));
  };
  const std::vector<Target> meant = targets(graph, departure);
  const auto first = [&](auto edit) {
    for (const Target& target : meant) {
      if (auto text = edit(target)) return text;
    }
    return std::optional<std::string>();
  };
  add(first([&](const Target& target) { return power_of_ten(form, target); }), "{}");
  add(first(
          [&](const Target& target) { return edited_text(transposed_digits(form), form, target); }),
      "as '{}', two digits swapped");
  const auto& forms = graph.node(departure.node).statements[departure.print.statement].forms;
  for (const std::size_t sound : departure.sound_forms) {
    if (sound == departure.print.form) continue;
    add(converted_from(forms[sound], form), "{}");
    for (const PrintedForm& shortened : omitted_digits(forms[sound])) {
      if (!departure.reading.empty() && printed_value(shortened) == printed_value(form)) {
        found.push_back(fmt::format("as '{}' with a digit lost", forms[sound].text));
        break;
      }
    }
  }
  if (!departure.reading.empty() && cut_like(form, departure.would_be) != 0.0 &&
      within(cut_like(form, departure.would_be) - form.value, 0.01 * form.half_unit)) {
    found.emplace_back("with its digits cut off instead of rounded");
  }
  add(first([&](const Target& target) { return changed_text(form, target); }),
      "as '{}', one digit different");
  // The formula is not known to have pi in it: only where nothing else fits.
  if (found.empty() && !departure.reading.empty()) add(short_pi(form, departure), "{}");
  return found;
}

std::vector<std::string> explain_as_slip(const AuditGraph& graph, const Departure& departure,
                                         const AuditGraph::Values& corrected) {
  std::vector<std::string> found;
  explain_by_rounded_parents(graph, departure, found);
  explain_by_other_prints(graph, departure, found);
  explain_by_corrected_parents(graph, departure, corrected, found);
  explain_by_other_quantities(graph, departure, found);
  return found;
}

std::vector<std::string> ancestors_needed(const AuditGraph& graph, const Departure& departure) {
  const PrintedForm& form = print_of(graph, departure.node, departure.print);
  struct Need {
    double change;
    std::string text;
  };
  std::vector<Need> needs;
  for (const auto& [ancestor, print] : departure.reading) {
    const PrintedForm& parent = print_of(graph, ancestor, print);
    if (parent.half_unit == 0.0) continue;  // a count
    const auto needed =
        ancestor_needed(graph, departure.node, departure.reading, ancestor, form.value);
    if (!needed) continue;
    needs.push_back({std::abs(*needed / parent.value - 1.0),
                     fmt::format("if {} were '{}' instead of '{}'", graph.node(ancestor).id,
                                 reprint(parent, *needed, 1), parent.text)});
  }
  std::stable_sort(needs.begin(), needs.end(),
                   [](const Need& a, const Need& b) { return a.change < b.change; });
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, needs.size()); ++i) {
    texts.push_back(needs[i].text);
  }
  return texts;
}

std::vector<CommonCause> common_causes(const AuditGraph& graph,
                                       const std::vector<Departure>& departures) {
  struct Span {
    double low, high;
    std::size_t departure;
  };
  std::map<std::size_t, std::vector<Span>> intervals;
  for (std::size_t d = 0; d < departures.size(); ++d) {
    const Departure& departure = departures[d];
    const PrintedForm& form = print_of(graph, departure.node, departure.print);
    for (const auto& [ancestor, print] : departure.reading) {
      if (print_of(graph, ancestor, print).half_unit == 0.0) continue;
      const auto low = ancestor_needed(graph, departure.node, departure.reading, ancestor,
                                       form.value - departure.tolerance);
      const auto high = ancestor_needed(graph, departure.node, departure.reading, ancestor,
                                        form.value + departure.tolerance);
      if (!low || !high) continue;
      const Span interval{std::min(*low, *high), std::max(*low, *high), d};
      const double shift = std::abs(0.5 * (*low + *high) - print_of(graph, ancestor, print).value);
      if (shift >= interval.high - interval.low) intervals[ancestor].push_back(interval);
    }
  }
  std::vector<CommonCause> causes;
  for (const auto& [ancestor, candidates] : intervals) {
    CommonCause best;
    std::size_t maximum = 2;
    for (const Span& start : candidates) {
      // The largest group of intervals with a common point has one at the start of one of them.
      double high = start.high;
      std::set<std::size_t> nodes;
      CommonCause group{ancestor, 0.0, {}};
      for (const Span& other : candidates) {
        if (other.low > start.low || other.high < start.low) continue;
        high = std::min(high, other.high);
        nodes.insert(departures[other.departure].node);
        group.departures.push_back(other.departure);
      }
      group.value = 0.5 * (start.low + high);
      if (nodes.size() > maximum) {
        maximum = nodes.size();
        best = group;
      }
    }
    if (!best.departures.empty()) causes.push_back(best);
  }
  return causes;
}

}  // namespace boresight::design
