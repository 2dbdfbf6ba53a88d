#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/figures/figure_csv.hpp>
#include <boresight/io/files/output_folder.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::app {
namespace {

// A signal handler can reach nothing else.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupt_seen = 0;

// What is printed is the process's: progress lines ask for it far below the command line.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
bool quiet_asked = false;

void see_interrupt(int /*signal*/) {
  interrupt_seen = 1;
}

}  // namespace

void add_case(CLI::App& command, std::string& path) {
  command.add_option("CASE", path, "case file (TOML), see docs/case-file.md")->required();
}

void add_outputs(CLI::App& command, Outputs& outputs) {
  command.add_flag("--details", outputs.details,
                   "print every section of the report, not only the result");
  command.add_option("--json", outputs.json_path,
                     "also write the report as JSON to this file; '-' writes JSON only, to "
                     "standard output");
  command.add_option("--report", outputs.report_path,
                     "also write the report as a self-contained page (HTML) with figures");
  command.add_option("--curves", outputs.curves_folder,
                     "also write every plotted curve as CSV into this folder");
}

void add_mat(CLI::App& command, Outputs& outputs) {
  command.add_option("--mat", outputs.mat_path,
                     "also write the linear models (plant; gains, controllers and closed loop of "
                     "the best controller) to this MAT file of version 5, see docs/formats.md");
}

void add_seed(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "first seed of the searches and samples")
      ->check(CLI::Range(0.0, 1e15))
      ->capture_default_str();
}

void add_threads(CLI::App& command, unsigned& threads) {
  threads = 0;
  command.add_option("--threads", threads,
                     "number of threads; results do not depend on it (default: all)");
}

unsigned all_or(unsigned threads) {
  return numerics::thread_count(threads);
}

const std::vector<std::pair<ExitCode, std::string>>& exit_code_meanings() {
  static const std::vector<std::pair<ExitCode, std::string>> meanings{
      {done, "done"},
      {internal_error, "internal error"},
      {bad_input, "bad input"},
      {infeasible, "constraints infeasible"},
      {numerical, "numerical failure, or no value to recommend"},
      {interrupted, "interrupted"}};
  return meanings;
}

void add_quiet(CLI::App& command) {
  command.add_flag("--quiet", quiet_asked, "print neither report nor progress");
}

bool quiet() {
  return quiet_asked;
}

void watch_for_interrupt() {
  std::signal(SIGINT, see_interrupt);
}

bool interrupt_requested() {
  return interrupt_seen != 0;
}

void Outputs::require_writable() const {
  if (!json_path.empty() && json_path != "-") io::require_writable(json_path);
  if (!report_path.empty()) io::require_writable(report_path);
  if (!mat_path.empty()) io::require_writable(mat_path);
  if (!curves_folder.empty()) {
    io::require_writable((io::output_folder(curves_folder, "curves") / "curves.csv").string());
  }
}

std::string Outputs::printed(const Document& document) const {
  std::string whole = to_text(document);
  if (details) return whole;
  std::string text = to_text(short_form(document));
  if (text.size() < whole.size()) {
    text += "\nAll sections: --details. Figures: --report FILE.html\n";
  }
  return text;
}

void Outputs::deliver(const Findings& findings) const {
  if (!mat_path.empty() && findings.mat) {
    io::write_atomically(mat_path, findings.mat());
  } else if (!mat_path.empty()) {
    fmt::print(stderr, "boresight: {} is not written: there is no model yet\n", mat_path);
  }
  if (!report_path.empty() || !curves_folder.empty()) {
    const Page page = findings.page();
    if (!curves_folder.empty()) write_curves(page.figures, curves_folder);
    if (!report_path.empty()) {
      io::write_atomically(report_path, to_html(page, {command_line, io::inputs_read()}));
    }
  }
  if (json_path == "-") {
    fmt::print("{}", findings.json());
  } else {
    if (!json_path.empty()) io::write_atomically(json_path, findings.json());
    if (!quiet()) fmt::print("{}", printed(findings.document()));
  }
  if (std::fflush(stdout) != 0) throw InvalidInput("standard output: cannot be written to");
}

}  // namespace boresight::app
