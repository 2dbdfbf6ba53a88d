#pragma once

#include <functional>

#include <boresight/app/match/match_section.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

struct WhatIfOptions {
  unsigned threads = 1;
  /// Laws done and all, under a lock.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  /// Asked between laws; true leaves the rest NaN and unstable.
  std::function<bool()> interrupted = {};
};

/// The table of a study: at its evenly spaced numbers of disks and as built; leakage from 0.3 to
/// 1.3 of the case's, friction slopes from 0 to 1.5 of that at the tracking rate, winds from half
/// to twice the design's. Goals in the winds of the table; on the case's plant alone otherwise.
/// Some 0.2 ms of one core an entry. The same for any number of threads.
/// @throws as design::MonteCarloJudge.
WhatIfTable what_if(const io::Case& antenna, const MatchSection& section,
                    const WhatIfOptions& options);

}  // namespace boresight::app
