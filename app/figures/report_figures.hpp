#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The figures of every section that a report has, each of an id of its own.
std::vector<Figure> report_figures(const Report& report);

}  // namespace boresight::app
