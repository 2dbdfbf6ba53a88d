#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double rms(const VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

double rms_about_mean(const VectorXd& values) {
  return rms((values.array() - values.mean()).matrix());
}

// How many steps of the course are left out.
Index settled_steps(const ReferenceTrajectory& course, double settling) {
  const double steps = std::round(settling / course.interval);
  if (!(steps >= 0.0) || !(steps < static_cast<double>(course.reference.size() - 1))) {
    throw InvalidInput(fmt::format(
        "integrator_agreement: expected a settling time of at least 0 s and shorter than the "
        "course's {} steps of {} s, found {} s",
        course.reference.size() - 1, course.interval, settling));
  }
  return static_cast<Index>(steps);
}

IntegratorAgreement compared_runs(const SimulatedLoop& loop, const ReferenceTrajectory& course,
                                  const IntegratorAgreementOptions& options,
                                  std::vector<Influence> without) {
  const Index settled = settled_steps(course, options.settling);
  const Index compared = course.reference.size() - 1 - settled;
  LoopRunOptions how;
  how.without = std::move(without);
  how.seed = options.seed;
  how.relative_tolerance = options.relative_tolerance;
  how.absolute_tolerance = options.absolute_tolerance;
  IntegratorAgreement agreement;
  agreement.duration = course.interval * static_cast<double>(compared);
  agreement.cvodes_relative_tolerance = options.cvodes_relative_tolerance;
  agreement.cvodes_absolute_tolerance = options.cvodes_absolute_tolerance;
  const auto has_completed = [&](const LoopRun& run) {
    agreement.status = run.status;
    agreement.message = run.message;
    return run.status == RunStatus::complete;
  };
  const LoopRun collocation = run_loop(loop, course, how);
  agreement.collocation_steps = collocation.result.statistics.steps;
  if (!has_completed(collocation)) return agreement;
  agreement.collocation_rms = rms_about_mean(collocation.boresight_error.tail(compared));
  how.integrator = plant::Integrator::cvodes;
  how.relative_tolerance = options.cvodes_relative_tolerance;
  how.absolute_tolerance = options.cvodes_absolute_tolerance;
  const LoopRun cvodes = run_loop(loop, course, how);
  agreement.cvodes_steps = cvodes.result.statistics.steps;
  if (!has_completed(cvodes)) return agreement;
  agreement.cvodes_rms = rms_about_mean(cvodes.boresight_error.tail(compared));
  agreement.difference_rms =
      rms((collocation.boresight_error - cvodes.boresight_error).tail(compared));
  return agreement;
}

}  // namespace

bool agree(const IntegratorAgreement& agreement) {
  return agreement.status == RunStatus::complete &&
         agreement.ratio_without_quantisation.value_or(agreement.ratio()) <=
             integrator_agreement_limit;
}

IntegratorAgreement integrator_agreement(const SimulatedLoop& loop,
                                         const ReferenceTrajectory& course,
                                         const IntegratorAgreementOptions& options) {
  IntegratorAgreement agreement = compared_runs(loop, course, options, {});
  if (agreement.status != RunStatus::complete || agree(agreement)) return agreement;
  const auto continuous = compared_runs(loop, course, options, {Influence::quantisation});
  if (continuous.status == RunStatus::complete) {
    agreement.ratio_without_quantisation = continuous.ratio();
  }
  return agreement;
}

}  // namespace boresight::design
