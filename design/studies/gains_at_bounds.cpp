#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/studies/gains_at_bounds.hpp>
#include <boresight/design/studies/position_gain_trade.hpp>

namespace boresight::design {
namespace {

using control::BlockKind;
using control::LoopBlock;

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
  for (const auto& name : control::usual_structures()) {
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

void add_simpler(const control::LoopStructure& structure, std::size_t block,
                 std::vector<SimplerStructure>& simpler) {
  std::vector<LoopBlock> blocks = structure.blocks();
  if (!can_do_without(blocks, blocks[block])) return;
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(block));
  const std::string usual = usual_name(blocks);
  auto found = std::ranges::find(simpler, usual, &SimplerStructure::name);
  if (found == simpler.end()) found = simpler.insert(found, {usual, {}});
  auto& names = found->in_place_of;
  std::string name = name_of(structure);
  if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
}

// Bounds that agree in what is printed of them are one for their user.
bool same_bound(const ReachedBound& one, const ReachedBound& other) {
  constexpr double printed = 1e-6;
  return one.upper == other.upper && one.gain.name == other.gain.name &&
         one.gain.symbol == other.gain.symbol && one.gain.unit == other.gain.unit &&
         one.sample_time == other.sample_time &&
         std::abs(one.value() - other.value()) <= printed * other.value();
}

void add_controller(const SearchedController& controller, std::size_t gain,
                    std::vector<ReachedBound>& reached) {
  const control::LoopStructure& structure = controller.tuning->controller.structure;
  const control::GainDescription& description = structure.gains()[gain];
  const double value = controller.tuning->controller.gains.at(gain);
  const ReachedBound own{
      description, ends_at_upper(description, value), controller.sample_time, {}, {}, {}};
  auto found = std::ranges::find_if(
      reached, [&](const ReachedBound& bound) { return same_bound(bound, own); });
  if (found == reached.end()) found = reached.insert(found, own);
  found->controllers.push_back(controller.name);
  const auto block = block_above(structure, gain);
  const bool beyond = controller.sample_time > 0.0 && own.upper &&
                      value > highest_frequency(controller.sample_time);
  if (!block || !beyond) return;
  found->idle = structure.blocks()[*block].kind;
  add_simpler(structure, *block, found->simpler);
}

}  // namespace

double highest_frequency(double sample_time) {
  return std::numbers::pi / sample_time;
}

std::vector<ReachedBound> reached_bounds(const std::vector<SearchedController>& controllers) {
  std::vector<ReachedBound> reached;
  for (const auto& one : controllers) {
    const auto& tuning = *one.tuning;
    if (tuning.status == TuningStatus::unstable) continue;
    const auto& descriptions = tuning.controller.structure.gains();
    // Without gains there is no controller.
    for (std::size_t k = 0; k < tuning.controller.gains.size(); ++k) {
      const auto& names = tuning.gains_at_bound;
      if (std::ranges::find(names, descriptions[k].name) == names.end()) continue;
      add_controller(one, k, reached);
    }
  }
  return reached;
}

bool ends_beyond_sampling(const TuningResult& tuning, double sample_time) {
  return std::ranges::any_of(reached_bounds({{"", &tuning, sample_time}}),
                             [](const ReachedBound& bound) { return bound.idle.has_value(); });
}

}  // namespace boresight::design
