#pragma once

#include <string>
#include <vector>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/montecarlo/montecarlo_section.hpp>
#include <boresight/app/report/report.hpp>
#include <boresight/app/simulate/simulation_report.hpp>

namespace boresight::app {

// The recommendations of a report, in a few self-contained sentences; its conclusions state the
// conditions. Fewer after an interrupt.
std::vector<std::string> decision(const Report& report);
std::vector<std::string> decision(const BenchmarkReport& report);
std::vector<std::string> decision(const MonteCarloSection& section);
std::vector<std::string> decision(const CommissionReport& report);
std::vector<std::string> decision(const SimulationReport& report);

// Assumptions and open questions of a redesign's decision, one or two sentences each. For other
// commands a resonance_warning; their conclusions hold the rest.
std::vector<std::string> reservations(const Report& report);

}  // namespace boresight::app
