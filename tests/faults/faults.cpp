// What identify makes of records with faults, over campaigns of random antennas simulated by the
// nonlinear model (tests/coverage):
//   boresight_faults [--campaigns N] [--first K] [--seed S] [--threads T] [--faults A,B,...]
//                    [--details CSV] [DOCUMENT]
// writes the table of N campaigns to DOCUMENT (else, and of chosen faults, to standard output). A
// fault is chosen by the beginning of its kind or name. The result depends on campaigns, seed and
// faults alone. Fails if a recommended inertia is off by more than 2 %, outside its interval and
// nothing faulty is named, unless these records cannot show an error of this size.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fault_case.hpp"
#include "fault_table.hpp"
#include "recorder_fault.hpp"
#include <boresight/numerics/parallel_loop.hpp>

namespace {

using namespace boresight::faults;

struct Arguments {
  std::uint64_t campaigns = 6;
  std::uint64_t first = 1;
  std::uint64_t seed = 1;
  unsigned threads = 2;
  std::vector<std::string> faults;
  std::string details;
  std::string document;
};

std::uint64_t whole_number(std::string_view option, std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value == 0) {
    throw std::runtime_error(
        fmt::format("{}: expected a whole number above 0, found '{}'", option, text));
  }
  return value;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

Arguments parse(const std::vector<std::string_view>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view option = words[i];
    if (!option.starts_with("--")) {
      arguments.document = option;
      continue;
    }
    if (++i == words.size()) throw std::runtime_error(fmt::format("{} needs a value", option));
    const std::string_view value = words[i];
    if (option == "--campaigns") {
      arguments.campaigns = whole_number(option, value);
    } else if (option == "--first") {
      arguments.first = whole_number(option, value);
    } else if (option == "--seed") {
      arguments.seed = whole_number(option, value);
    } else if (option == "--threads") {
      arguments.threads = static_cast<unsigned>(whole_number(option, value));
    } else if (option == "--faults") {
      arguments.faults = words_of(value);
    } else if (option == "--details") {
      arguments.details = value;
    } else {
      throw std::runtime_error(fmt::format(
          "expected --campaigns, --first, --seed, --threads, --faults or --details, found {}",
          option));
    }
  }
  if (!arguments.faults.empty()) arguments.document.clear();
  return arguments;
}

// Of all faults, one campaign.
std::vector<FaultCase> run(const Arguments& arguments, const std::vector<RecorderFault>& faults,
                           std::uint64_t campaign) {
  const Recorded recorded = recorded_campaign(arguments.seed, campaign, {});
  std::vector<FaultCase> cases(faults.size());
  std::mutex mutex;
  std::size_t done = 0;
  boresight::numerics::for_each_index(cases.size(), arguments.threads, [&](std::size_t i) {
    cases[i] = fault_case(faults[i], recorded, arguments.seed, {});
    const std::lock_guard lock(mutex);
    if (++done % 20 == 0) {
      fmt::print(stderr, "campaign {}: {} of {} faults\n", campaign, done, cases.size());
    }
  });
  return cases;
}

// What the records show of the stated numbers that faults put in error.
std::string detection(const std::vector<RecorderFault>& faults,
                      const std::vector<FaultCase>& cases) {
  std::string text;
  for (const RecorderFault& fault : faults) {
    if (fault.stated_number.empty()) continue;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    std::size_t fitted = 0, held = 0;
    for (const FaultCase& one : cases) {
      if (one.fault != fault.name || !one.check) continue;
      ++fitted;
      held += one.without_holds ? 1U : 0U;
      least = std::min(least, one.check->visible_error);
      most = std::max(most, one.check->visible_error);
    }
    if (fitted == 0) continue;
    text += fmt::format(
        "- *{}*: {}. The {} is {:+.1f} % in error, and errors from {:.1f} to {:.1f} % on show. "
        "The inertia's interval without it holds the truth in {} of {} campaigns.\n",
        fault.name, fault.why_hidden, fault.stated_number, 100.0 * fault.stated_error,
        100.0 * least, 100.0 * most, held, fitted);
  }
  return text.empty() ? text : "\nWhat these records show of stated numbers in error:\n\n" + text;
}

std::string document(const Arguments& arguments, std::uint64_t last,
                     const std::vector<RecorderFault>& faults,
                     const std::vector<FaultCase>& cases) {
  return fmt::format(
             R"(## Faults of recorders and transducers

What `identify` makes of records with one fault each: {} faults on campaigns {} to {} of seed {},
written by `./dev faults`. The campaigns are those of `./dev coverage` (previous section) with three
constant speeds, four minutes in all, and an encoder: the antenna's simulated angle, with 4 to 30
million steps a turn and half a step of noise. The setting of `identify` is the same too. The faults
are listed in tests/faults/recorder_fault.cpp and tests/faults/record_faults.cpp.

- *right*: an inertia is recommended, within 2 % of the truth, and its 95 % interval holds the
  truth; *not covered*: it does not.
- *flagged*: nothing is recommended, and the faulty channel or record is among the three findings
  about the data; *refused*: nothing is recommended and nothing named; *other flagged*: only other
  channels are named.
- *warned*: an inertia more than 2 % off is recommended, but the faulty channel or record is named;
  *wide*: it is not named, but the interval holds the truth. *Undetectable*: it does not, and the
  fault is smaller than what these records show of the stated number that it puts in error (3.5
  standard uncertainties, printed by `identify` for each number), but the inertia's interval without
  that number, printed beside it, holds the truth; *silently wrong*: the same without that.
- *largest error*: of what is recommended, all campaigns.

)",
             std::ranges::count_if(faults, [](const auto& one) { return one.kind != "none"; }),
             arguments.first, last, arguments.seed) +
         fault_markdown(cases) + detection(faults, cases);
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

bool holds(const std::vector<FaultCase>& cases) {
  bool all = true;
  for (const FaultCase& one : cases) {
    if (one.outcome != Outcome::silently_wrong) continue;
    fmt::print(stderr, "{}, campaign {}: {:+.1f} %, silently\n", one.fault, one.campaign,
               100.0 * one.error);
    all = false;
  }
  return all;
}

}  // namespace

int main(int count, char** words) try {
  const Arguments arguments = parse({words + 1, words + count});
  const auto faults = recorder_faults(arguments.faults);
  // By fault, then campaign. What is done is written after each campaign.
  std::vector<std::vector<FaultCase>> by_fault(faults.size());
  std::vector<FaultCase> cases;
  for (std::uint64_t i = 0; i < arguments.campaigns; ++i) {
    auto found = run(arguments, faults, arguments.first + i);
    cases.clear();
    for (std::size_t k = 0; k < faults.size(); ++k) {
      by_fault[k].push_back(std::move(found[k]));
      cases.insert(cases.end(), by_fault[k].begin(), by_fault[k].end());
    }
    const std::string text = document(arguments, arguments.first + i, faults, cases);
    const bool last = i + 1 == arguments.campaigns;
    if (!arguments.document.empty()) {
      write(arguments.document, text);
    } else if (last) {
      fmt::print("{}", text);
    }
    if (!arguments.details.empty()) write(arguments.details, fault_details(cases));
  }
  return holds(cases) ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "boresight_faults: {}\n", error.what());
  return 2;
}
