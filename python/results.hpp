#pragma once

#include <string>

#include <boresight/app/report/report.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/numerics/statistics/propagation.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::python {

/// What a function found, as the report that the program writes of it. Base of all results.
struct Found {
  app::Report report;
};

/// A report that says what was asked, still without an answer.
app::Report report_of(const io::Case& antenna, const std::string& command, std::uint64_t seed);

numerics::Interval interval_of(const numerics::PropagatedResult& result);

/// A plant of a case, and what is known of it.
struct Plant : Found {
  app::PlantSection section;
  plant::StateSpace state_space;
};

}  // namespace boresight::python
