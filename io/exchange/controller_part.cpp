#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

std::string chosen_part(const std::vector<std::string>& parts, const std::string& asked,
                        const std::string& file) {
  constexpr const char* usual = "controller";
  const auto has = [&](const std::string& part) {
    return std::ranges::find(parts, part) != parts.end();
  };
  if (asked.empty()) return has(usual) ? usual : "";
  if (has(asked)) return asked;
  throw InvalidInput(
      fmt::format("{}: expected a part {}, found {}", file, in_quotes(asked),
                  parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "))));
}

}  // namespace boresight::io
