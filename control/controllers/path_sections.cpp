#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

struct Polynomials {
  std::vector<double> numerator, denominator;
};

// `g`: the gains of the block.
Polynomials polynomials(const LoopBlock& block, const double* g) {
  switch (block.kind) {
    case BlockKind::gain:
      return {{g[0]}, {1.0}};
    case BlockKind::integral:
      return {{g[0], 1.0}, {0.0, 1.0}};
    case BlockKind::lag:
      return {{1.0}, {1.0, 1.0 / g[0]}};
    case BlockKind::lead:
      return {{1.0, 1.0 / g[0]}, {1.0}};
    case BlockKind::washout:
      return {{0.0, 1.0}, {g[0], 1.0}};
    case BlockKind::notch:
      return {{g[0] * g[0], 2.0 * g[1] * g[0], 1.0}, {g[0] * g[0], 2.0 * g[2] * g[0], 1.0}};
    case BlockKind::dead_zone:
    case BlockKind::freeze:
      break;
  }
  throw InvalidInput("controller: not a kind of block");
}

}  // namespace

std::vector<PathSection> path_sections(const Controller& controller, LoopPath path) {
  std::vector<PathSection> sections;
  std::vector<std::vector<double>> leads;
  double gain = 1.0;
  const LoopBlock* gain_block = nullptr;
  const double* gains = controller.gains.data();
  for (const LoopBlock& block : controller.structure.blocks()) {
    const double* own = gains;
    gains += block.gains.size();
    if (block.path != path || is_integral_condition(block.kind)) continue;
    Polynomials section = polynomials(block, own);
    if (block.kind == BlockKind::gain) {
      gain = own[0];
      gain_block = &block;
    } else if (block.kind == BlockKind::lead) {
      leads.push_back(std::move(section.numerator));
    } else {
      sections.push_back({block.kind, block.gains.front().symbol, std::move(section.numerator),
                          std::move(section.denominator)});
    }
  }
  for (PathSection& section : sections) {
    if (section.kind != BlockKind::lag || leads.empty()) continue;
    section.numerator = std::move(leads.back());
    leads.pop_back();
  }
  if (sections.empty()) {
    if (gain_block == nullptr) return {};
    return {{BlockKind::gain, gain_block->gains.front().symbol, {gain}, {1.0}}};
  }
  for (double& coefficient : sections.front().numerator) coefficient *= gain;
  return sections;
}

double path_gain(const Controller& controller, LoopPath path) {
  double product = 1.0;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (block.path == path && block.kind == BlockKind::gain) product *= controller.gains[k];
    k += block.gains.size();
  }
  return product;
}

}  // namespace boresight::control
