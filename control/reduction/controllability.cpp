#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/equations/mode_distance.hpp>
#include <boresight/control/reduction/controllability.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;

std::vector<std::string> main_states(const Eigen::VectorXcd& combination,
                                     const std::vector<std::string>& names, int most) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Eigen::VectorXd share = combination.cwiseAbs2();
  const auto share_of = [&](std::size_t i) { return share[static_cast<Index>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return share_of(a) > share_of(b); });
  std::vector<std::string> result;
  for (const std::size_t i : order) {
    if (std::cmp_equal(result.size(), most) || share_of(i) < 0.1 * share.maxCoeff()) break;
    result.push_back(names[i]);
  }
  return result;
}

std::string describe(const std::vector<ModeAccess>& unreached,
                     const std::vector<std::string>& ports, const char* kind, const char* verb) {
  if (unreached.empty()) return {};
  std::vector<std::string> eigenvalues;
  for (const auto& mode : unreached) {
    eigenvalues.push_back(fmt::format("{} (states {})", describe_eigenvalue(mode.eigenvalue),
                                      fmt::join(mode.states, ", ")));
  }
  const bool one_port = ports.size() == 1;
  return fmt::format("the {}{} {} do{} not {} the eigenvalue{} {}", kind, one_port ? "" : "s",
                     fmt::join(ports, ", "), one_port ? "es" : "", verb,
                     unreached.size() == 1 ? "" : "s", fmt::join(eigenvalues, ", "));
}

Access access(const plant::StateSpace& system, const AccessOptions& options, const char* kind,
              const char* verb) {
  const plant::StateSpace balanced = plant::balanced(system);
  Access result;
  if (balanced.states.empty()) return result;
  const auto domain = system.sample_time > 0.0 ? TimeDomain::sampled : TimeDomain::continuous;
  ModeDistance distances(numerics::real_schur(balanced.a), balanced.b, balanced.a.norm(), domain);
  const auto append = [&](const ModeDistance& from, const ModeDistance::Mode& mode) {
    result.modes.push_back({mode.eigenvalue, mode.distance, from.stable(mode.eigenvalue),
                            main_states(mode.combination, system.states, options.most_states),
                            from.by_port(mode.combination)});
  };
  std::vector<ModeDistance::Mode> doubtful;
  for (auto& mode : distances.modes(options.tolerance)) {
    if (mode.distance > options.tolerance) {
      append(distances, mode);
    } else {
      doubtful.push_back(std::move(mode));
    }
  }
  if (!doubtful.empty()) {
    // Balancing takes a coupling that is a rounding error for one that counts and may then scale
    // others out of sight: what is out of reach must be so in the states as given, too.
    ModeDistance as_given(numerics::real_schur(system.a), system.b, system.a.norm(), domain);
    for (const auto& mode : doubtful) {
      const ModeDistance::Mode other = as_given.test(mode.eigenvalue);
      if (other.distance > options.tolerance) {
        append(as_given, other);
      } else {
        append(distances, mode);
      }
    }
  }
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  for (const auto& mode : result.modes) {
    if (mode.distance <= options.tolerance) result.unreached.push_back(mode);
  }
  result.description = describe(result.unreached, system.inputs, kind, verb);
  return result;
}

}  // namespace

bool Access::leaves_only_stable() const {
  return std::all_of(unreached.begin(), unreached.end(),
                     [](const ModeAccess& mode) { return mode.stable; });
}

Access controllability(const plant::StateSpace& system, const AccessOptions& options) {
  return access(system, options, "input", "reach");
}

Access observability(const plant::StateSpace& system, const AccessOptions& options) {
  plant::validate(system);
  plant::StateSpace transposed = system;
  transposed.a = system.a.transpose();
  transposed.b = system.c.transpose();
  transposed.c = system.b.transpose();
  transposed.d = system.d.transpose();
  std::swap(transposed.inputs, transposed.outputs);
  return access(transposed, options, "output", "show");
}

}  // namespace boresight::control
