#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/usual_structures.hpp>

namespace boresight::app {
namespace {

using control::BlockKind;
using control::LoopBlock;

// What stands in the place of structures once a block that does nothing is left out.
struct Replacement {
  std::string by;
  std::vector<std::string> structures;
};

struct ReachedBound {
  std::string text;
  double sample_time = 0.0;
  std::vector<std::string> laws = {};
  std::optional<BlockKind> idle = std::nullopt;  // whose corner no sampled controller reaches
  std::vector<Replacement> replacements = {};
};

// "the upper bound of the compliance, cs = 0.1 rad/(N.m)": the one that the gain is nearer to.
std::string bound_text(const control::GainDescription& gain, double value) {
  const bool upper = design::ends_at_upper(gain, value);
  return fmt::format("the {} bound of the {}, {} = {:g}{}", upper ? "upper" : "lower", gain.name,
                     gain.symbol, upper ? gain.upper : gain.lower,
                     gain.unit == "1" ? "" : " " + gain.unit);
}

double highest_frequency(double sample_time) {
  return std::numbers::pi / sample_time;
}

// The block that does nothing below the frequency that this gain is; none for other gains.
std::optional<std::size_t> block_above(const control::LoopStructure& structure, std::size_t gain) {
  std::size_t first = 0;
  const auto& blocks = structure.blocks();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const BlockKind kind = blocks[b].kind;
    const bool passes_below =
        kind == BlockKind::lag || kind == BlockKind::lead || kind == BlockKind::notch;
    // A notch's frequency is its first gain.
    if (first == gain && passes_below) return b;
    first += blocks[b].gains.size();
  }
  return std::nullopt;
}

// A lead cannot do without a lag in its path.
bool can_do_without(const std::vector<LoopBlock>& blocks, const LoopBlock& left_out) {
  const auto count = [&](BlockKind kind) {
    return std::ranges::count_if(blocks, [&](const LoopBlock& block) {
      return block.path == left_out.path && block.kind == kind;
    });
  };
  return left_out.kind != BlockKind::lag || count(BlockKind::lag) > count(BlockKind::lead);
}

// The usual structure of such blocks, by its short name; empty if there is none.
std::string usual_name(const std::vector<LoopBlock>& blocks) {
  const auto kinds = [](const std::vector<LoopBlock>& of) {
    std::vector<std::pair<control::LoopPath, BlockKind>> found;
    for (const auto& block : of) found.emplace_back(block.path, block.kind);
    std::ranges::sort(found);
    return found;
  };
  const auto wanted = kinds(blocks);
  for (const auto& name : io::usual_structures()) {
    if (kinds(control::LoopStructure::named(name).blocks()) == wanted) return name;
  }
  return "";
}

// As the user names it.
std::string name_of(const control::LoopStructure& structure) {
  std::string usual = usual_name(structure.blocks());
  const bool own = usual.empty() || control::LoopStructure::named(usual) != structure;
  return own ? structure.name() : usual;
}

void add_replacement(const control::LoopStructure& structure, std::size_t block,
                     std::vector<Replacement>& replacements) {
  std::vector<LoopBlock> blocks = structure.blocks();
  if (!can_do_without(blocks, blocks[block])) return;
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(block));
  const std::string usual = usual_name(blocks);
  const std::string by = usual.empty() ? "a [[loop]] without it" : "structure " + usual;
  auto found = std::ranges::find(replacements, by, &Replacement::by);
  if (found == replacements.end()) found = replacements.insert(found, {by, {}});
  auto& names = found->structures;
  std::string name = name_of(structure);
  if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
}

void add_law(const SearchedLaw& law, std::size_t gain, std::vector<ReachedBound>& reached) {
  const control::LoopStructure& structure = law.tuning->law.structure;
  const control::GainDescription& description = structure.gains()[gain];
  const double value = law.tuning->law.gains.at(gain);
  const std::string text = bound_text(description, value);
  auto found = std::ranges::find_if(reached, [&](const ReachedBound& bound) {
    return bound.text == text && bound.sample_time == law.sample_time;
  });
  if (found == reached.end()) found = reached.insert(found, {text, law.sample_time});
  found->laws.push_back(law.name);
  const auto block = block_above(structure, gain);
  const bool beyond = law.sample_time > 0.0 && design::ends_at_upper(description, value) &&
                      value > highest_frequency(law.sample_time);
  if (!block || !beyond) return;
  found->idle = structure.blocks()[*block].kind;
  add_replacement(structure, *block, found->replacements);
}

std::vector<ReachedBound> reached_bounds(const std::vector<SearchedLaw>& laws) {
  std::vector<ReachedBound> reached;
  for (const auto& one : laws) {
    const auto& tuning = *one.tuning;
    if (tuning.status == design::TuningStatus::unstable) continue;
    const auto& descriptions = tuning.law.structure.gains();
    // Without gains there is no law.
    for (std::size_t k = 0; k < tuning.law.gains.size(); ++k) {
      const auto& names = tuning.gains_at_bound;
      if (std::ranges::find(names, descriptions[k].name) == names.end()) continue;
      add_law(one, k, reached);
    }
  }
  return reached;
}

// Empty where the bound's corner, if it is one, lies where a sampled controller acts.
std::string beyond_sampling(const ReachedBound& bound) {
  if (!bound.idle) return "";
  std::string text = fmt::format(
      "A controller that samples every {:g} s does nothing above {:.0f} rad/s, and so such a {} "
      "does nothing in it",
      bound.sample_time, highest_frequency(bound.sample_time), control::to_string(*bound.idle));
  std::vector<std::string> ways;
  for (const auto& one : bound.replacements) {
    ways.push_back(fmt::format("{} in the place of {}", one.by, fmt::join(one.structures, ", ")));
  }
  return text + (ways.empty() ? "." : fmt::format(": leave it out ({}).", fmt::join(ways, "; ")));
}

}  // namespace

std::vector<std::string> gains_at_bounds(const std::vector<SearchedLaw>& laws) {
  std::vector<std::string> sentences;
  for (const auto& bound : reached_bounds(laws)) {
    std::string text = fmt::format(
        "The search ended at {}, with {}: no optimum, as what lies beyond was not looked at "
        "(bounds of a [[tuning.bound]], or of a [[loop]], do).",
        bound.text, fmt::join(bound.laws, ", "));
    if (const std::string more = beyond_sampling(bound); !more.empty()) text += " " + more;
    sentences.push_back(std::move(text));
  }
  return sentences;
}

std::vector<std::string> gains_at_bounds(const std::vector<const TunedLaw*>& laws,
                                         double sample_time) {
  std::vector<SearchedLaw> searched;
  for (const TunedLaw* row : laws) {
    if (row->tuned_for == TunedFor::present) continue;
    searched.push_back({fmt::format("{} ({}, {:.3g} m/s)", row->structure,
                                    to_string(row->tuned_for), row->wind_speed),
                        &row->design.tuning, sample_time});
  }
  return gains_at_bounds(searched);
}

std::vector<std::string> corners_beyond_sampling(const SearchedLaw& law) {
  std::vector<std::string> sentences;
  for (const auto& bound : reached_bounds({law})) {
    if (std::string text = beyond_sampling(bound); !text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences;
}

std::vector<std::string> gain_trades(const std::vector<const TunedLaw*>& laws,
                                     const io::GainUnits& units) {
  std::vector<std::string> sentences;
  for (const TunedLaw* row : laws) {
    if (!row->trade) continue;
    sentences.push_back(trade_in_words(*row->trade, units,
                                       fmt::format("{} ({}, {:.3g} m/s)", row->structure,
                                                   to_string(row->tuned_for), row->wind_speed),
                                       row->beam_rms,
                                       row->ensemble ? row->ensemble->members.size() : 0));
  }
  return sentences;
}

std::vector<std::string> about_bounds(const design::TuningStudy& study, const io::GainUnits& units,
                                      const std::vector<const TunedLaw*>& laws) {
  auto sentences = gains_at_bounds(laws, control::sample_time_of(study.problem.delay));
  std::ranges::move(gain_trades(laws, units), std::back_inserter(sentences));
  return sentences;
}

}  // namespace boresight::app
