#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/case/table_reader.hpp>
#include <boresight/io/case/toml_tree.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/proposals/changeable_numbers.hpp>
#include <boresight/io/proposals/proposal.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr double largest_factor = 1000.0;

// What a number says of itself when it is no quantity but a factor.
Quantity read_factor(TableReader& details, Quantity factor) {
  if (details.has("basis") || details.optional_text("basis")) {
    const std::string basis =
        details.choice("basis", {"measured", "published", "inferred", "assumed"});
    for (const auto known : {Basis::measured, Basis::published, Basis::inferred, Basis::assumed}) {
      if (basis == to_string(known)) factor.basis = known;
    }
  }
  factor.source = details.optional_text("source").value_or("");
  return factor;
}

// A table of the file and the same table of its tree, which tells a factor from a value.
class ChangeTable {
 public:
  ChangeTable(TableReader reader, const TomlNode& node) : reader_(std::move(reader)), node_(node) {}

  TableReader& reader() { return reader_; }

  // The change that stands at `key`, if any, as one of `path` in the case.
  void read(const char* key, const std::string& path, Kind kind, const Range& range,
            std::vector<ProposedChange>& changes) {
    const TomlNode* found = node_.find(key);
    if (found == nullptr || found->type != TomlType::table || found->find("factor") == nullptr) {
      if (auto value = reader_.optional_quantity(key, kind, range)) {
        changes.push_back({path, std::move(*value), false});
      }
      return;
    }
    TableReader details = reader_.table(key);
    if (details.has("value")) {
      details.refuse("factor", "expected either a value or a factor, found both");
    }
    Quantity factor = details.quantity("factor", Kind::number, Range::between(0.0, largest_factor));
    if (auto uncertainty = details.optional_quantity("uncertainty", Kind::number,
                                                     Range::not_negative(largest_factor))) {
      factor.standard_uncertainty =
          uncertainty->text.ends_with('%') ? uncertainty->value * factor.value : uncertainty->value;
      factor.uncertainty_given = true;
    }
    factor.uncertainty_source = details.optional_text("uncertainty_source").value_or("");
    factor = read_factor(details, std::move(factor));
    details.finish();
    changes.push_back({path, std::move(factor), true});
  }

  // Whether a value stands at `key`, and no factor.
  bool has_value(const char* key) const {
    const TomlNode* found = node_.find(key);
    if (found == nullptr) return false;
    if (found->type != TomlType::table) return true;
    return found->find("value") != nullptr && found->find("factor") == nullptr;
  }

  void whole_number(const ProposedChange& change, const char* key) const {
    if (!change.multiplies && change.number.value != std::round(change.number.value)) {
      reader_.refuse(
          key, fmt::format("expected a whole number, found {}", in_quotes(change.number.text)));
    }
  }

 private:
  TableReader reader_;
  const TomlNode& node_;
};

class ProposalReader {
 public:
  ProposalReader(std::string_view text, const std::string& path)
      : root_(parse_toml(text, path)), file_(TableReader::parse(text, path)) {
    proposal_.path = path;
  }

  Proposal read() {
    read_head();
    read_cost();
    read_numbers("antenna");
    read_motor();
    read_gear();
    read_oil();
    for (const char* table : {"drive", "simulation", "friction_curve"}) read_numbers(table);
    check_valve();
    read_structure();
    read_numbers("sensors");
    read_controller();
    file_.finish();
    return std::move(proposal_);
  }

 private:
  void read_head() {
    proposal_.name = file_.text("name");
    proposal_.name_location = file_.location("name");
    const bool blank = proposal_.name.find_first_not_of(' ') == std::string::npos;
    const bool control = std::ranges::any_of(
        proposal_.name, [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; });
    if (blank || control || character_count(proposal_.name) > 60) {
      file_.refuse("name", fmt::format("expected a name of 1 to 60 printable characters, found {}",
                                       in_quotes(proposal_.name)));
    }
    proposal_.description = file_.text("description");
    if (file_.has("risks")) proposal_.risks = file_.texts("risks");
    proposal_.structures_location = file_.location("structures");
    if (file_.has("structures")) {
      proposal_.structures = file_.texts("structures");
      if (proposal_.structures.empty()) {
        file_.refuse("structures", "expected the name of a loop structure or more, found none");
      }
      std::set<std::string> once;
      for (const auto& name : proposal_.structures) {
        if (!once.insert(name).second) {
          file_.refuse("structures", fmt::format("expected each structure once, found {} again",
                                                 in_quotes(name)));
        }
      }
    }
    // Known keys all the same.
    for (const char* key : {"risks", "structures"}) {
      if (!file_.has(key)) file_.optional_text(key);
    }
  }

  void read_cost() {
    auto table = file_.optional_table("cost");
    if (!table) return;
    proposal_.cost_location = table->location();
    ProposedCost cost;
    cost.amount = table->quantity("amount", Kind::number, Range::not_negative(1e15));
    cost.currency = table->text("currency");
    if (cost.currency.empty()) {
      table->refuse("currency", "expected a currency such as 'kUSD of 2026', found ''");
    }
    table->finish();
    proposal_.cost = std::move(cost);
  }

  // A table of the file with its tree; none if the file has not got it.
  std::optional<ChangeTable> open(const char* name) {
    auto table = file_.optional_table(name);
    if (!table) return std::nullopt;
    return ChangeTable(std::move(*table), *root_.find(name));
  }

  void read_fields(ChangeTable& table, std::string_view name) {
    for (const auto& number : changeable_numbers()) {
      if (name == number.table) {
        table.read(number.key, number.path(), number.kind, number.range, proposal_.changes);
      }
    }
  }

  void read_numbers(const char* name) {
    if (auto table = open(name)) {
      read_fields(*table, name);
      table->reader().finish();
    }
  }

  void read_motor() {
    auto table = open("motor");
    if (!table) return;
    const std::size_t before = proposal_.changes.size();
    table->read("count", "motor.count", Kind::number, Range::between(1.0, 1000.0),
                proposal_.changes);
    if (proposal_.changes.size() > before) table->whole_number(proposal_.changes.back(), "count");
    table->read("flywheel_disks", "motor.flywheel_disks", Kind::number, Range::not_negative(10000),
                proposal_.changes);
    read_fields(*table, "motor");
    table->reader().finish();
  }

  void read_gear() {
    auto table = open("gear_train");
    if (!table) return;
    const TomlNode& node = *root_.find("gear_train");
    auto stages = table->reader().tables("stage");
    std::set<long> changed;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const long stage = stages[i].integer("number", 1, 1000);
      if (!changed.insert(stage).second) {
        stages[i].refuse("number",
                         fmt::format("expected each stage once, found stage {} again", stage));
      }
      ChangeTable inner(std::move(stages[i]), node.find("stage")->elements[i]);
      const std::size_t before = proposal_.changes.size();
      for (const char* teeth : {"driven_teeth", "driving_teeth"}) {
        const std::size_t already = proposal_.changes.size();
        inner.read(teeth, fmt::format("gear_train.stage[{}].{}", stage, teeth), Kind::number,
                   Range::positive(1e6), proposal_.changes);
        if (proposal_.changes.size() > already) {
          inner.whole_number(proposal_.changes.back(), teeth);
        }
      }
      inner.reader().finish();
      if (proposal_.changes.size() == before) {
        inner.reader().refuse("number",
                              "expected driven_teeth or driving_teeth beside it, found neither");
      }
    }
    auto assemblies = table->reader().tables("assembly");
    std::set<std::string> names;
    for (std::size_t i = 0; i < assemblies.size(); ++i) {
      const std::string name = assemblies[i].text("name");
      if (!names.insert(name).second) {
        assemblies[i].refuse(
            "name", fmt::format("expected each assembly once, found {} again", in_quotes(name)));
      }
      ChangeTable inner(std::move(assemblies[i]), node.find("assembly")->elements[i]);
      const std::size_t before = proposal_.changes.size();
      inner.read("inertia", fmt::format("gear_train.assembly[{}].inertia", name), Kind::inertia,
                 Range::positive(), proposal_.changes);
      inner.reader().finish();
      if (proposal_.changes.size() == before) {
        inner.reader().refuse("inertia", "expected the assembly's inertia, found none");
      }
    }
    table->reader().finish();
  }

  // A change that only a factor can say.
  void read_only_factor(ChangeTable& table, const char* key, const std::string& path,
                        const char* of_what) {
    if (table.has_value(key)) {
      table.reader().refuse(
          key, fmt::format("expected {{ factor = \"...\" }}, which multiplies {}, found a value",
                           of_what));
    }
    table.read(key, path, Kind::number, Range::positive(largest_factor), proposal_.changes);
  }

  void read_oil() {
    auto table = open("oil");
    if (!table) return;
    table->read("bulk_modulus", "oil.bulk_modulus", Kind::pressure, Range::between(1e7, 1e10),
                proposal_.changes);
    read_fields(*table, "oil");
    read_only_factor(*table, "line_lengths", "oil.line_lengths", "the lengths of all lines");
    const bool lines = proposal_.find("oil.line_lengths") != nullptr;
    table->read("line_share", "oil.line_share", Kind::number, Range::between(0.0, 1.0),
                proposal_.changes);
    if (const auto* fraction = proposal_.find("oil.line_share"); fraction != nullptr) {
      if (fraction->multiplies) {
        table->reader().refuse("line_share", "expected a fraction within 0 to 1, found a factor");
      }
      if (!lines) {
        table->reader().refuse("line_share",
                               "expected it beside line_lengths, whose change it carries into the "
                               "volumes, found no line_lengths");
      }
    }
    table->reader().finish();
  }

  void check_valve() const {
    const auto* flow = proposal_.find("drive.valve_rated_flow");
    if (flow == nullptr || proposal_.find("simulation.valve_stroke") == nullptr) return;
    refuse_at(flow->number.location, flow->key,
              "expected either valve_rated_flow, from which the valve's stroke follows, or "
              "simulation.valve_stroke, found both");
  }

  void read_structure() {
    auto table = open("structure");
    if (!table) return;
    read_fields(*table, "structure");
    read_only_factor(*table, "gear_stiffness", "structure.gear_stiffness",
                     "the stiffness of the gear spring");
    if (proposal_.find("structure.gear_stiffness") != nullptr &&
        proposal_.find("structure.locked_rotor_frequency") != nullptr) {
      table->reader().refuse("gear_stiffness",
                             "expected either gear_stiffness, from which the locked-rotor "
                             "frequency follows, or locked_rotor_frequency, found both");
    }
    read_only_factor(*table, "mode_frequencies", "structure.mode_frequencies",
                     "the frequencies of all modes");
    read_only_factor(*table, "mode_damping_ratios", "structure.mode_damping_ratios",
                     "the damping ratios of all modes");
    table->reader().finish();
  }

  void read_controller() {
    auto table = open("controller");
    if (!table) return;
    const std::size_t before = proposal_.changes.size();
    table->read("sample_rate", "controller.sample_rate", Kind::frequency, Range::positive(1e6),
                proposal_.changes);
    if (proposal_.changes.size() > before && proposal_.changes.back().multiplies) {
      table->reader().refuse("sample_rate",
                             "expected a frequency such as \"100 Hz\", found a "
                             "factor (a case states the delay only)");
    }
    read_fields(*table, "controller");
    table->reader().finish();
  }

  TomlNode root_;
  TableReader file_;
  Proposal proposal_;
};

}  // namespace

const ProposedChange* Proposal::find(std::string_view key) const {
  const auto found = std::ranges::find(changes, key, &ProposedChange::key);
  return found != changes.end() ? &*found : nullptr;
}

Proposal parse_proposal(std::string_view text, const std::string& path) {
  return ProposalReader(text, path).read();
}

Proposal read_proposal(const std::string& path) {
  return parse_proposal(read_input(path), path);
}

}  // namespace boresight::io
