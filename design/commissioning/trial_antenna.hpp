#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <boresight/design/commissioning/commissioning_check.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {

struct TrialOptions {
  std::uint64_t seed = 1;
  unsigned threads = 1;
  double rms_allowance = 1.2;  // of CommissioningOptions
  /// Polled between plants; true ends the work (@throws Interrupted).
  std::function<bool()> stop = {};
  /// Called with the numbers of plants done and in total, from the calling thread.
  std::function<void(std::size_t, std::size_t)> progress = {};
};

/// A mission's antenna, on which stages of commissioning are tried with changes of its numbers.
class TrialAntenna {
 public:
  TrialAntenna(const Mission& mission, const CommandedMove& move);
  /// The changed antenna, commissioned with the feedforward of the unchanged one.
  /// @throws InvalidInput as plant::changed and StageObserver.
  StageObserver observer(const std::vector<plant::AntennaChange>& changes,
                         const SignalFactors& factors = {}) const;

 private:
  const Mission& mission_;  // outlives the object
  CommandedMove move_;
  TrackingProblem problem_;
  WindTable wind_;
};

/// Calls `work(i)` for the plants from `first` up to but not including `last`, on several threads,
/// in blocks between which it polls and reports. @throws Interrupted; what `work` throws.
void for_each_plant(std::size_t first, std::size_t last, const TrialOptions& options,
                    const std::function<void(std::size_t)>& work);

}  // namespace boresight::design
