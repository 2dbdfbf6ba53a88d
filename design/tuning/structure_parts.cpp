#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

using control::BlockKind;
using control::Controller;
using control::GainDescription;
using control::LoopBlock;
using control::LoopPath;
using control::LoopStructure;

const GainDescription* find(const LoopStructure& structure, const std::string& symbol) {
  const auto found = std::ranges::find(structure.gains(), symbol, &GainDescription::symbol);
  return found == structure.gains().end() ? nullptr : &*found;
}

double middle(double lower, double upper) {
  return std::sqrt(lower * upper);
}

// Of gain k of a block that the other controller does not have.
double neutral_gain(const LoopBlock& block, std::size_t k) {
  const GainDescription& gain = block.gains[k];
  switch (block.kind) {
    case BlockKind::gain:
    case BlockKind::integral:
      return gain.lower;
    case BlockKind::lag:
    case BlockKind::lead:
      // A lag where the other has none, a compliance's corner.
      return block.path == LoopPath::compliance ? middle(gain.lower, gain.upper) : gain.upper;
    case BlockKind::washout:
    case BlockKind::dead_zone:
    case BlockKind::freeze:
      break;
    case BlockKind::notch:
      if (k == 0) break;
      // Flat with as much damping above as below.
      const GainDescription& other = block.gains[3 - k];
      const double lower = std::max(gain.lower, other.lower);
      const double upper = std::min(gain.upper, other.upper);
      return std::clamp(middle(lower, upper), gain.lower, gain.upper);
  }
  return middle(gain.lower, gain.upper);
}

// Of the places with parts those whose parts are all in earlier waves or have none themselves.
std::vector<std::vector<std::size_t>> waves_of(const std::vector<std::vector<std::size_t>>& parts) {
  std::vector<bool> placed(parts.size());
  std::size_t left = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    placed[i] = parts[i].empty();
    if (!placed[i]) ++left;
  }
  std::vector<std::vector<std::size_t>> waves;
  while (left > 0) {
    std::vector<std::size_t> wave;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto is_placed = [&](std::size_t part) { return placed.at(part); };
      if (!placed[i] && std::ranges::all_of(parts[i], is_placed)) wave.push_back(i);
    }
    if (wave.empty()) throw std::invalid_argument("structure parts: one is a part of itself");
    for (const std::size_t i : wave) placed[i] = true;
    left -= wave.size();
    waves.push_back(std::move(wave));
  }
  return waves;
}

}  // namespace

bool extends(const LoopStructure& whole, const LoopStructure& part) {
  return part.gains().size() < whole.gains().size() &&
         std::ranges::all_of(part.gains(), [&](const GainDescription& gain) {
           return find(whole, gain.symbol) != nullptr;
         });
}

std::vector<std::vector<std::size_t>> parts_of(const std::vector<LoopStructure>& structures) {
  std::vector<std::vector<std::size_t>> parts(structures.size());
  for (std::size_t s = 0; s < structures.size(); ++s) {
    for (std::size_t part = 0; part < structures.size(); ++part) {
      if (!extends(structures[s], structures[part])) continue;
      const bool between = std::ranges::any_of(structures, [&](const auto& one) {
        return extends(one, structures[part]) && extends(structures[s], one);
      });
      if (!between) parts[s].push_back(part);
    }
  }
  return parts;
}

std::vector<LoopStructure> missing_parts(const std::vector<LoopStructure>& structures,
                                         const std::vector<LoopStructure>& usual) {
  std::vector<LoopStructure> all = structures;
  for (const auto& one : usual) {
    if (std::ranges::find(structures, one) == structures.end()) all.push_back(one);
  }
  std::vector<bool> wanted(all.size(), false);
  const auto parts = parts_of(all);
  for (std::size_t s = 0; s < structures.size(); ++s) {
    for (const std::size_t part : parts[s]) wanted[part] = true;
  }
  std::vector<LoopStructure> missing;
  for (std::size_t i = structures.size(); i < all.size(); ++i) {
    if (wanted[i]) missing.push_back(all[i]);
  }
  return missing;
}

void search_then_improve(const std::vector<std::vector<std::size_t>>& parts, unsigned threads,
                         const std::function<void(std::size_t)>& search,
                         const std::function<void(std::size_t)>& improve) {
  const auto waves = waves_of(parts);
  numerics::for_each_index(parts.size(), threads, search);
  for (const auto& wave : waves) {
    numerics::for_each_index(wave.size(), threads, [&](std::size_t i) { improve(wave[i]); });
  }
}

std::size_t steps_of_search(const std::vector<std::vector<std::size_t>>& parts) {
  const auto with_parts = std::ranges::count_if(parts, [](const auto& of) { return !of.empty(); });
  return parts.size() + static_cast<std::size_t>(with_parts);
}

std::vector<double> transferred_gains(const Controller& controller,
                                      const LoopStructure& structure) {
  std::vector<double> gains;
  for (const LoopBlock& block : structure.blocks()) {
    for (std::size_t k = 0; k < block.gains.size(); ++k) {
      const GainDescription& gain = block.gains[k];
      const bool shared = find(controller.structure, gain.symbol) != nullptr;
      gains.push_back(
          shared ? std::clamp(control::gain(controller, gain.symbol), gain.lower, gain.upper)
                 : neutral_gain(block, k));
    }
  }
  return gains;
}

std::vector<std::vector<double>> starts_from_part(const Controller& controller,
                                                  const LoopStructure& structure,
                                                  std::uint64_t seed, int random) {
  std::vector<std::vector<double>> starts{transferred_gains(controller, structure)};
  std::mt19937_64 generator(seed);
  for (int i = 0; i < random; ++i) {
    std::vector<double> gains = starts.front();
    for (std::size_t k = 0; k < gains.size(); ++k) {
      const GainDescription& gain = structure.gains()[k];
      if (find(controller.structure, gain.symbol) != nullptr) continue;
      // 53 random bits, so that the sequence does not depend on the standard library.
      const double fraction = static_cast<double>(generator() >> 11U) * 0x1p-53;
      gains[k] = gain.lower * std::pow(gain.upper / gain.lower, fraction);
    }
    starts.push_back(std::move(gains));
  }
  return starts;
}

}  // namespace boresight::design
