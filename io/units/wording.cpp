#include <algorithm>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/units/printable.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr int longest_quotation = 60;

unsigned char byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

bool continues_character(unsigned char byte) {
  return (byte & 0xC0U) == 0x80U;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') {
      letter = static_cast<char>(letter - 'A' + 'a');
    }
  }
  return lower;
}

/// Insertions, deletions, replacements and swaps of neighbours between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string shown = "'";
  int characters = 0;
  for (std::size_t i = 0; i < text.size(); ++characters) {
    if (characters == longest_quotation) {
      return shown + "...'";
    }
    const std::size_t length = printable_length(text, i);
    if (length == 0) {
      shown += fmt::format("\\x{:02X}", byte_at(text, i));
      ++i;
    } else {
      shown += text.substr(i, length);
      i += length;
    }
  }
  return shown + "'";
}

int character_count(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return !continues_character(static_cast<unsigned char>(c));
  }));
}

std::string with_article(std::string_view name) {
  const bool vowel =
      !name.empty() && std::string_view("aeiou").find(name[0]) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", name);
}

std::string_view nearest_name(std::string_view misspelt, std::span<const std::string_view> known) {
  const std::string wrong = lower_case(misspelt);
  for (const std::string_view name : known) {
    if (lower_case(name) == wrong) {
      return name;
    }
  }
  // A single letter is one edit away from every other: no suggestion is better than a random one.
  if (wrong.size() < 2) {
    return {};
  }
  const std::size_t farthest = std::clamp<std::size_t>(wrong.size() / 3, 1, 3);
  std::string_view nearest;
  std::size_t minimum = farthest + 1;
  for (const std::string_view name : known) {
    const std::size_t difference =
        std::max(name.size(), wrong.size()) - std::min(name.size(), wrong.size());
    if (name.size() < 2 || difference > farthest) {
      continue;
    }
    const std::size_t distance = edit_distance(wrong, lower_case(name));
    if (distance < minimum) {
      minimum = distance;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace boresight::io
