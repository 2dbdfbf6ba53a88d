#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// What to tune; empty and 0: as the case has it.
struct TuneOptions {
  std::vector<std::string> structures;
  std::vector<double> wind_speeds;  // m/s
  int starts = 0;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Asked now and then, from any thread; true ends the work with the best laws found so far.
  std::function<bool()> interrupted;
};

/// Plants that may be the true one, and what they were drawn from.
struct PlantEnsemble {
  std::string source;
  std::vector<design::EnsembleMember> members;
};

/// Tunes each structure at each wind speed, for the case's plant alone and for every member of the
/// ensemble, judges them and the present gains, and says what cannot be reached. The same for any
/// number of threads.
/// @throws InvalidInput for a structure that is none or asked for twice, a speed outside 0.1 to 60
/// m/s, and goals that design::validate or the case's tables do not allow.
TuneSection tune_structures(const io::Case& antenna, const PlantEnsemble& ensemble,
                            const TuneOptions& options);

/// What design::recommend chooses on the linear plant alone, where only 0.1 % of the rms is a tie:
/// at one wind speed, or at the first that has a robust design which meets every constraint, else a
/// nominal one. Null if there is none.
const TunedLaw* best_law(const TuneSection& section, std::optional<double> wind_speed = {});

/// What decides whether a budget can be met, no choice of a controller: of the designs of
/// best_law's purpose and wind speed that are not left_out, that of the least budget_rms; where all
/// are, the same of those whose run in wind completed; best_law where none did.
const TunedLaw* nearest_to_budget(const TuneSection& section,
                                  std::optional<double> wind_speed = {});

/// What of the goals, budgets and plant the laws of a finished study do not reach, with the closest
/// that they do. Empty if every wind speed has a law that meets everything.
std::vector<Shortfall> find_shortfalls(const TuneSection& section);

/// A few sentences that say what the table means: the best law, before and after, the price of
/// robustness, what limits.
std::vector<std::string> conclude(const TuneSection& section);

}  // namespace boresight::app
