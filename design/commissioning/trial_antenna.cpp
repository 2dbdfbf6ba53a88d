#include <algorithm>

#include <boresight/design/commissioning/trial_antenna.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {

TrialAntenna::TrialAntenna(const Mission& mission, const CommandedMove& move)
    : mission_(mission), move_(move), problem_(tracking_problem(mission)), wind_(problem_) {}

StageObserver TrialAntenna::observer(const std::vector<plant::AntennaChange>& changes,
                                     const SignalFactors& factors) const {
  return {problem_, plant::linear_plant(plant::changed(mission_.antenna, changes)), wind_, move_,
          factors};
}

void for_each_plant(std::size_t first, std::size_t last, const TrialOptions& options,
                    const std::function<void(std::size_t)>& work) {
  constexpr std::size_t block = 50;
  for (std::size_t from = first; from < last; from += block) {
    if (options.stop && options.stop()) throw Interrupted("interrupted by the user");
    const std::size_t count = std::min(block, last - from);
    numerics::for_each_index(count, options.threads, [&](std::size_t i) { work(from + i); });
    if (options.progress) options.progress(from + count, last);
  }
}

}  // namespace boresight::design
