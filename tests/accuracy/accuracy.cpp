// Measures the library against what others found (tests/data/reference) and writes the table:
//   boresight_accuracy DOCUMENT           writes it
//   boresight_accuracy --check DOCUMENT   compares it with what is there, changing nothing
// Fails if an error is larger than asked, or the document is another.
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "accuracy_table.hpp"

namespace {

using namespace boresight::reference;

constexpr const char* introduction = R"(# Accuracy

What the library computes beside what others have published or computed (`tests/data/reference`
says who). Written by `./dev accuracy`; a test compares it with what the program writes.

- *digits*: significant digits of the reference.
- *error*: of ours, relative; the largest among the numbers of the row, in a matrix relative to its
  largest element. Where rounding decides it and not the digits of the reference, only the power of
  ten above it is given.
- *asked*: largest error allowed; *last digit*: half a unit of the last digit the reference is
  printed with.

The last two sections take longer than a test may: how often the intervals of identified numbers
hold the truth, by `./dev coverage`, and what becomes of faulty records, by `./dev faults`.
)";

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string document(bool& holds) {
  const std::vector<std::function<AccuracySection()>> sections = {
      margin_accuracy, state_space_margin_accuracy, norm_accuracy,
      step_accuracy,   sampling_accuracy,           dead_time_accuracy,
      zero_accuracy,   matrix_equation_accuracy,    slicot_accuracy,
      peer_accuracy};
  std::string text = introduction;
  for (const auto& section : sections) {
    const AccuracySection rows = section();
    text += "\n" + rows.markdown();
    holds = holds && rows.holds();
  }
  for (const char* table : {"/tests/coverage/table.md", "/tests/faults/table.md"}) {
    text += "\n" + text_of(std::string(BORESIGHT_SOURCE_DIR) + table);
  }
  return text;
}

}  // namespace

int main(int count, char** arguments) try {
  const bool check = count == 3 && std::string(arguments[1]) == "--check";
  if (count != 2 && !check) {
    fmt::print(stderr, "usage: boresight_accuracy [--check] DOCUMENT\n");
    return 2;
  }
  bool holds = true;
  const std::string text = document(holds);
  const std::string path = arguments[count - 1];
  if (check) {
    std::string difference;
    if (!same_table(text, text_of(path), difference)) {
      fmt::print(stderr, "{} is not what ./dev accuracy writes, {}\n", path, difference);
      return 1;
    }
  } else {
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path);
  }
  if (!holds) fmt::print(stderr, "an error is larger than asked: FAILS in the table\n");
  return holds ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "boresight_accuracy: {}\n", error.what());
  return 1;
}
