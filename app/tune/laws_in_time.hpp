#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What a simulated law is called.
std::string description_of(const TunedLaw& row);

/// What ran of a design among those of a section; null if nothing did.
const design::NonlinearVerification* run_of(const TimeDomainSection& section, const TunedLaw& row);

/// Says of each usable law of `purpose` what it does on the nonlinear antenna (TunedLaw::in_time):
/// at the wind speed of `compared` by what ran there, at the speeds that budgets are needed up to
/// by runs of their own, some seconds a law; then looks for shortfalls again. Nothing for a case
/// without a [simulation] table. The same for any number of threads.
void judge_in_time(const io::Case& antenna, const std::optional<TimeDomainSection>& compared,
                   TunedFor purpose, std::uint64_t seed, unsigned threads,
                   const std::function<bool()>& interrupted, TuneSection& section);

/// What the nonlinear antenna has against a law: "hunts by +-7.42 mdeg"; empty where the law did
/// not run or is not left_out.
std::string held_against(const TunedLaw& row);

}  // namespace boresight::app
