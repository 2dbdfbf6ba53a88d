#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

using control::BlockKind;
using control::LoopPath;

constexpr std::array paths{LoopPath::rate, LoopPath::pressure, LoopPath::position,
                           LoopPath::compliance};
constexpr std::array kinds{BlockKind::gain,      BlockKind::integral, BlockKind::lag,
                           BlockKind::lead,      BlockKind::washout,  BlockKind::notch,
                           BlockKind::dead_zone, BlockKind::freeze};

// Out of a closed list of values by their names.
template <typename Value, std::size_t count>
Value read_value(TableReader& table, const char* key, const std::array<Value, count>& values) {
  std::vector<std::string> names;
  for (const Value value : values) names.emplace_back(control::to_string(value));
  const std::string chosen = table.choice(key, names);
  return values.at(static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin()));
}

// The gains of a block: the key of each in a case, and what it is called behind its path.
struct GainWords {
  const char* key = "";
  const char* name = "";
  const char* symbol = "";
};
std::vector<GainWords> words_of(BlockKind kind) {
  switch (kind) {
    case BlockKind::gain:
      return {{"gain", "gain", "k"}};
    case BlockKind::integral:
      return {{"corner", "integral corner", "wi"}};
    case BlockKind::lag:
      return {{"corner", "lag corner", "wp"}};
    case BlockKind::lead:
      return {{"corner", "lead corner", "wz"}};
    case BlockKind::washout:
      return {{"corner", "washout corner", "wd"}};
    case BlockKind::dead_zone:
      return {{"width", "integral dead zone", "dz"}};
    case BlockKind::freeze:
      return {{"width", "integral freeze", "fz"}};
    case BlockKind::notch:
      break;
  }
  return {{"frequency", "notch frequency", "wn"},
          {"zero_damping", "notch numerator damping", "zz"},
          {"pole_damping", "notch denominator damping", "zp"}};
}

// As the usual structures call them where they have it: kr, wi, wp, kT, wd, kp, wip, cs, wcs.
std::pair<std::string, std::string> name_and_symbol(LoopPath path, BlockKind kind,
                                                    const GainWords& words) {
  if (path == LoopPath::compliance && kind == BlockKind::gain) return {"compliance", "cs"};
  if (path == LoopPath::compliance && kind == BlockKind::lag) return {"compliance corner", "wcs"};
  if (path == LoopPath::pressure && kind == BlockKind::gain)
    return {"pressure feedback gain", "kT"};
  if (path == LoopPath::pressure && kind == BlockKind::washout) {
    return {"pressure washout corner", "wd"};
  }
  if (path == LoopPath::rate && kind == BlockKind::notch) return {words.name, words.symbol};
  const bool marked = kind == BlockKind::gain || kind == BlockKind::washout;
  static const std::map<LoopPath, std::string> endings{{LoopPath::rate, "r"},
                                                       {LoopPath::pressure, "T"},
                                                       {LoopPath::position, "p"},
                                                       {LoopPath::compliance, "c"}};
  const std::string ending = path == LoopPath::rate && !marked ? "" : endings.at(path);
  return {fmt::format("{} {}", control::to_string(path), words.name), words.symbol + ending};
}

struct BlockEntry {
  control::LoopBlock block;
  std::vector<Quantity> lower, upper, present;
};

BlockEntry read_block(TableReader& table, std::map<std::string, int>& symbols) {
  BlockEntry entry;
  entry.block.path = read_value(table, "path", paths);
  entry.block.kind = read_value(table, "kind", kinds);
  std::size_t index = 0;
  for (const auto& words : words_of(entry.block.kind)) {
    const Kind kind = gain_kind(entry.block.path, entry.block.kind, index++);
    TableReader gain = table.table(words.key);
    const Quantity lower = gain.quantity("lower", kind, Range::positive(1e11));
    const Quantity upper = gain.quantity("upper", kind, Range::positive(1e11));
    const auto present = gain.optional_quantity("present", kind, Range::positive(1e11));
    gain.finish();
    if (upper.value <= lower.value) {
      gain.refuse("upper", fmt::format("expected more than the lower bound {}, found {}",
                                       in_quotes(lower.text), in_quotes(upper.text)));
    }
    auto [name, symbol] = name_and_symbol(entry.block.path, entry.block.kind, words);
    if (const int before = symbols[symbol]++; before > 0) {
      name += fmt::format(" {}", before + 1);
      symbol += fmt::format("{}", before + 1);
    }
    entry.block.gains.push_back({std::move(name), std::move(symbol),
                                 std::string(describe(kind).si_unit), lower.value, upper.value});
    entry.lower.push_back(lower);
    entry.upper.push_back(upper);
    if (present) entry.present.push_back(*present);
  }
  table.finish();
  return entry;
}

bool is_usual(const std::string& name) {
  return std::ranges::any_of(control::usual_structures(), [&](const std::string& usual) {
    return name == usual || name == control::LoopStructure::named(usual).name();
  });
}

void append(std::vector<Quantity>& all, const std::vector<Quantity>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

LoopEntry read_loop(TableReader& table, std::set<std::string>& names) {
  LoopEntry entry;
  const std::string name = read_name(table, names);
  if (is_usual(name) || name == design::state_space_name) {
    table.refuse("name", "expected a name that no usual structure has, found " + in_quotes(name));
  }
  std::vector<control::LoopBlock> blocks;
  std::map<std::string, int> symbols;
  for (auto& block : table.tables("block", true)) {
    BlockEntry one = read_block(block, symbols);
    append(entry.lower, one.lower);
    append(entry.upper, one.upper);
    append(entry.present, one.present);
    blocks.push_back(std::move(one.block));
  }
  table.finish();
  if (!entry.present.empty() && entry.present.size() != entry.lower.size()) {
    table.refuse("block", fmt::format("expected a present value of all gains or of none, found {} "
                                      "of {}",
                                      entry.present.size(), entry.lower.size()));
  }
  try {
    entry.structure = control::LoopStructure(name, std::move(blocks));
  } catch (const InvalidInput& error) {
    table.refuse("block", error.what());
  }
  return entry;
}

PresentGainsEntry read_gains(TableReader& table, const Case& antenna) {
  PresentGainsEntry entry;
  const std::string name = table.text("structure");
  try {
    entry.structure = loop_structure(antenna, name);
  } catch (const InvalidInput& error) {
    table.refuse("structure", error.what());
  }
  // All that there are first: beside a missing one they are no misspelt keys.
  const Range range = Range::positive(1e11);
  std::map<std::string, Quantity> found;
  for (const auto& block : entry.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      const auto& symbol = block.gains[i].symbol;
      const Kind kind = gain_kind(block.path, block.kind, i);
      if (auto gain = table.optional_quantity(symbol, kind, range)) found[symbol] = *gain;
    }
  }
  if (found.empty()) {
    table.finish();
    return entry;
  }
  for (const auto& block : entry.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      const auto& symbol = block.gains[i].symbol;
      entry.gains.push_back(
          found.contains(symbol)
              ? found.at(symbol)
              : table.quantity(symbol, gain_kind(block.path, block.kind, i), range));
    }
  }
  table.finish();
  return entry;
}

std::optional<RangeEntry> read_range(TableReader& table, const char* key, Kind kind,
                                     const Range& range) {
  auto ends = table.optional_table(key);
  if (!ends) return std::nullopt;
  RangeEntry entry{ends->quantity("lower", kind, range), ends->quantity("upper", kind, range)};
  ends->finish();
  if (entry.upper.value < entry.lower.value) {
    ends->refuse("upper", fmt::format("expected at least the lower end {}, found {}",
                                      in_quotes(entry.lower.text), in_quotes(entry.upper.text)));
  }
  return entry;
}

// Every block of the usual structures.
const std::vector<control::LoopBlock>& all_blocks() {
  static const std::vector<control::LoopBlock> blocks = [] {
    std::vector<control::LoopBlock> all = control::LoopStructure::named("FULL+N+C").blocks();
    for (const char* name : {"FULL+L+D", "FULL+F"}) {
      const auto structure = control::LoopStructure::named(name);
      for (const auto& block : structure.blocks()) {
        const bool known = std::ranges::any_of(all, [&](const control::LoopBlock& one) {
          return one.gains.front().symbol == block.gains.front().symbol;
        });
        if (!known) all.push_back(block);
      }
    }
    return all;
  }();
  return blocks;
}

control::LoopStructure bounded(const control::LoopStructure& structure,
                               const std::vector<GainBoundEntry>& bounds) {
  if (bounds.empty()) return structure;
  std::vector<control::LoopBlock> blocks = structure.blocks();
  for (auto& block : blocks) {
    for (auto& gain : block.gains) {
      const auto found = std::ranges::find(bounds, gain.symbol, &GainBoundEntry::symbol);
      if (found == bounds.end()) continue;
      const auto &lower = found->lower, &upper = found->upper;
      const double width = gain.upper / gain.lower;
      if (lower) gain.lower = lower->value;
      if (upper) gain.upper = upper->value;
      // An end that is not stated gives way; both of one entry rise.
      if (!upper && gain.upper <= gain.lower) gain.upper = width * gain.lower;
      if (!lower && gain.lower >= gain.upper) gain.lower = gain.upper / width;
    }
  }
  return {structure.name(), std::move(blocks)};
}

// About one step of the encoder, where the case does not state both bounds.
control::LoopStructure with_width(const Case& antenna, const control::LoopStructure& structure) {
  const double step = design::encoder_step(antenna.sensors->encoder_noise.value);
  if (step > 0.0) return structure.with_integral_width(step * gear_ratio(antenna));
  const bool stated = std::ranges::any_of(antenna.tuning->bounds, [&](const GainBoundEntry& one) {
    return one.lower && one.upper &&
           std::ranges::any_of(structure.blocks(), [&](const control::LoopBlock& block) {
             return control::is_integral_condition(block.kind) &&
                    block.gains.front().symbol == one.symbol;
           });
  });
  if (!stated) {
    throw InvalidInput(
        fmt::format("{}: expected encoder noise, whose step is the width of its integral, or both "
                    "bounds of the width in [[tuning.bound]], found neither",
                    structure.name()));
  }
  return structure;
}

GainBoundEntry read_bound(TableReader& table, std::set<std::string>& symbols) {
  std::vector<std::string> known;
  for (const auto& block : all_blocks()) {
    for (const auto& gain : block.gains) known.push_back(gain.symbol);
  }
  GainBoundEntry bound;
  bound.symbol = table.choice("gain", known);
  Kind kind = Kind::number;
  for (const auto& block : all_blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      if (block.gains[i].symbol == bound.symbol) kind = gain_kind(block.path, block.kind, i);
    }
  }
  bound.lower = table.optional_quantity("lower", kind, Range::positive(1e11));
  bound.upper = table.optional_quantity("upper", kind, Range::positive(1e11));
  table.finish();
  if (!symbols.insert(bound.symbol).second) {
    table.refuse("gain", fmt::format("expected one [[tuning.bound]] of each gain, found another of "
                                     "{}",
                                     in_quotes(bound.symbol)));
  }
  if (!bound.lower && !bound.upper) {
    table.refuse("upper", "expected lower, upper or both, found neither");
  }
  if (bound.lower && bound.upper && bound.upper->value <= bound.lower->value) {
    table.refuse("upper", fmt::format("expected more than the lower bound {}, found {}",
                                      in_quotes(bound.lower->text), in_quotes(bound.upper->text)));
  }
  return bound;
}

}  // namespace

Kind gain_kind(control::LoopPath path, control::BlockKind kind, std::size_t index) {
  if (kind == BlockKind::notch && index > 0) return Kind::number;
  if (control::is_integral_condition(kind)) return Kind::angle;
  if (kind != BlockKind::gain) return Kind::bandwidth_frequency;
  switch (path) {
    case LoopPath::rate:
      break;
    case LoopPath::pressure:
      return Kind::rate_per_torque;
    case LoopPath::position:
      return Kind::proportional_gain;
    case LoopPath::compliance:
      return Kind::compliance;
  }
  return Kind::number;
}

control::LoopStructure loop_structure(const Case& antenna, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& entry : antenna.loops) {
    if (entry.structure.name() == name) return entry.structure;
    names.push_back(in_quotes(entry.structure.name()));
  }
  if (is_usual(name)) {
    const auto usual = control::LoopStructure::named(name).with_bounds_for(driven_load(antenna));
    return bounded(usual.has_conditional_integral() ? with_width(antenna, usual) : usual,
                   antenna.tuning->bounds);
  }
  std::vector<std::string_view> known(control::usual_structures().begin(),
                                      control::usual_structures().end());
  for (const auto& entry : antenna.loops) known.push_back(entry.structure.name());
  throw InvalidInput(
      fmt::format("expected {}PI-0, PI, DPF, LL or FULL, with +L (position lag instead of "
                  "integrals), +D or +F (dead zone or freeze of the integral), +N (notch) and +C "
                  "(compliance compensation) behind it as wanted, found {}{}",
                  names.empty() ? "" : fmt::format("{}, ", fmt::join(names, ", ")), in_quotes(name),
                  did_you_mean(name, known)));
}

void check_structure(const Case& antenna, const std::string& name) {
  if (name != design::state_space_name) loop_structure(antenna, name);
}

std::vector<control::LoopStructure> usual_structures_with_lag(const Case& antenna) {
  std::vector<control::LoopStructure> usual;
  for (const auto& name : control::usual_structures()) {
    const bool conditional = control::LoopStructure::named(name).has_conditional_integral();
    if (!name.starts_with("PI-0") && !conditional) usual.push_back(loop_structure(antenna, name));
  }
  return usual;
}

void read_loops(TableReader& file, Case& antenna) {
  std::set<std::string> names;
  for (auto& table : file.tables("loop")) antenna.loops.push_back(read_loop(table, names));
  auto tuning = file.optional_table("tuning");
  if (tuning) {
    std::set<std::string> symbols;
    for (auto& bound : tuning->tables("bound")) {
      antenna.tuning->bounds.push_back(read_bound(bound, symbols));
    }
  }
  // Its structure has those bounds.
  if (auto table = file.optional_table("gains")) {
    antenna.present_gains = read_gains(*table, antenna);
  }
  if (tuning) {
    if (tuning->has("structures")) {
      antenna.tuning->structures = tuning->texts("structures");
    } else {
      tuning->optional_text("structures");  // a known key all the same
    }
    antenna.tuning->starts = tuning->optional_integer("starts", 1, 100000).value_or(0);
    tuning->finish();
    for (const auto& name : antenna.tuning->structures) {
      try {
        check_structure(antenna, name);
      } catch (const InvalidInput& error) {
        tuning->refuse("structures", error.what());
      }
    }
  }
}

void read_ensemble(TableReader& file, Case& antenna) {
  auto table = file.optional_table("ensemble");
  if (!table) return;
  EnsembleEntry& ensemble = *antenna.ensemble;
  ensemble.random_samples = table->optional_integer("draws", 1, 10000).value_or(0);
  const Range factor = Range::between(0.05, 20.0);
  ensemble.structure_frequency = read_range(*table, "structure_frequency", Kind::number, factor);
  ensemble.oil_stiffness = read_range(*table, "oil_stiffness", Kind::number, factor);
  ensemble.leakage_rate =
      read_range(*table, "leakage_rate", Kind::rate_constant, Range::positive(1000.0));
  ensemble.viscous_friction =
      read_range(*table, "viscous_friction", Kind::viscous_friction, Range::not_negative());
  table->finish();
}

}  // namespace boresight::io
