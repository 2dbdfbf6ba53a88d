#pragma once

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/change/change_report.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/montecarlo/montecarlo_section.hpp>
#include <boresight/app/page/page.hpp>
#include <boresight/app/report/report.hpp>
#include <boresight/app/simulate/simulation_report.hpp>

namespace boresight::app {

// A command's report as a page: its text, its figures, the decision.
Page page_of(const Report& report);
Page page_of(const BenchmarkReport& report);
Page page_of(const ChangeReport& report);
Page page_of(const MonteCarloSection& section);
Page page_of(const CommissionReport& report);
Page page_of(const SimulationReport& report);

}  // namespace boresight::app
