#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

struct EvaluateOptions {
  /// Of the antenna as it is and of proposals that name none; empty: as tune.
  std::vector<std::string> structures;
  std::size_t draws = 2000;
  int starts = 0;  // of each search; 0: as the case has it
  /// Laws run on the nonlinear antenna, if the case has a [simulation], and are compared by that.
  bool time_domain = true;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Asked now and then, from any thread; true ends the work with what is whole.
  std::function<bool()> interrupted;
};

/// Plants that may be the true one, whatever a proposal makes of the case.
struct PlantUncertainty {
  design::PlantDistribution distribution;
  /// Its members are draws of the distribution; else those of tune/plant_members.hpp.
  bool from_records = false;
};

/// Whether the proposals fit the case and one another: to be asked before any work.
/// @throws InvalidInput as evaluate_proposals.
void check_proposals(const io::Case& antenna, const std::vector<io::Proposal>& proposals);

/// Tunes the antenna as it is and every proposal with the same draws of what is uncertain
/// (study_controllers), and compares what is recommended for each. Without proposals: the antenna
/// as it is alone. The same for any number of threads.
/// @throws InvalidInput as apply_proposal, and for two proposals of one name or of different
/// currencies, a structure that is none, fewer than 100 draws.
EvaluateSection evaluate_proposals(const io::Case& antenna,
                                   const std::vector<io::Proposal>& proposals,
                                   const PlantUncertainty& uncertainty,
                                   const EvaluateOptions& options);

/// The plant of a draw on a case that a proposal made of another: factors apply to whatever the
/// proposal makes of the number; the friction slope scales with the friction curve's slope at the
/// tracking rate.
plant::AntennaPlant proposed_plant(const io::Case& as_is, const io::Case& proposed,
                                   const design::PlantDraw& draw);

/// Chances, regrets and what decides, of the candidates with a stable law; `cases` in their order,
/// the antenna as it is first. Interrupted, or with fewer than two of them: no draws.
DecisionSection decide(const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases,
                       const design::PlantDistribution& distribution,
                       const EvaluateOptions& options);

}  // namespace boresight::app
