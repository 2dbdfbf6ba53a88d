#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/exchange/gains_by_key.hpp>
#include <boresight/io/units/units.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

control::Controller controller_by_key(const Case& antenna, const std::string& structure,
                                      const std::vector<std::string>& gains) {
  control::Controller controller{loop_structure(antenna, structure), {}};
  std::vector<std::string> known;
  for (const auto& block : controller.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      const std::string& symbol = block.gains[i].symbol;
      known.push_back(symbol);
      const auto text = std::ranges::find_if(
          gains, [&](const std::string& one) { return one.starts_with(symbol + "="); });
      if (text == gains.end()) {
        throw InvalidInput(fmt::format("--gains: expected a value for {} ({}) of {}, found none",
                                       symbol, block.gains[i].name, structure));
      }
      try {
        controller.gains.push_back(
            parse_quantity(text->substr(symbol.size() + 1), gain_kind(block.path, block.kind, i))
                .value);
      } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("--gains {}: {}", in_quotes(*text), error.what()));
      }
    }
  }
  for (const auto& text : gains) {
    const std::string symbol = text.substr(0, text.find('='));
    if (std::ranges::find(known, symbol) == known.end()) {
      throw InvalidInput(fmt::format("--gains {}: expected KEY=VALUE with a key of {}, found none",
                                     in_quotes(text), fmt::join(known, ", ")));
    }
  }
  control::validate(controller);
  return controller;
}

}  // namespace boresight::io
