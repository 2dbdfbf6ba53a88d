#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/figures/montecarlo_figures.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/uncertainty/distribution_source.hpp>
#include <boresight/design/studies/monte_carlo_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/exchange/monte_carlo_checkpoint.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Clock = std::chrono::steady_clock;

// The antenna and what its plants are drawn from, which the outcome keeps.
using Population = std::shared_ptr<const io::DesignedAntenna>;

// Anything that goes wrong on one rank, on every one, by its kind. Kinds in the order of exit
// codes.
struct Trouble {
  char kind = ' ';  // ' ': none
  std::string message;
};

void rethrow(const Trouble& trouble) {
  switch (trouble.kind) {
    case ' ':
      return;
    case 'i':
      throw InvalidInput(trouble.message);
    case 'f':
      throw InfeasibleRequirement(trouble.message);
    case 'n':
      throw NumericalFailure(trouble.message);
    case 's':
      throw Interrupted(trouble.message);
    default:
      throw std::runtime_error(trouble.message);
  }
}

// Does the work on this rank, then, if it failed on any, throws the failure of the first on all.
template <typename Work>
void on_all(Ranks& ranks, Work work) {
  Trouble trouble;
  try {
    work();
  } catch (const InvalidInput& error) {
    trouble = {'i', error.what()};
  } catch (const InfeasibleRequirement& error) {
    trouble = {'f', error.what()};
  } catch (const NumericalFailure& error) {
    trouble = {'n', error.what()};
  } catch (const Interrupted& error) {
    trouble = {'s', error.what()};
  } catch (const std::exception& error) {
    trouble = {'x', error.what()};
  }
  if (ranks.size() == 1) return rethrow(trouble);
  if (!ranks.any(trouble.kind != ' ')) return;
  std::string first;
  for (const auto& one : ranks.gather(trouble.kind + trouble.message)) {
    if (first.empty() && one[0] != ' ') first = one;
  }
  first = ranks.broadcast(first);
  rethrow({first[0], first.substr(1)});
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Exact, so that every rank holds the same controller to the last bit.
std::string controller_bytes(const ChosenController& fixed_gain) {
  std::ostringstream text;
  text << fixed_gain.structure << '\n' << fixed_gain.source << '\n';
  if (const auto* system = fixed_gain.controller.structure.state_space()) {
    text << io::controller_json(*system);
    return text.str();
  }
  text << std::hexfloat;
  for (const double gain : fixed_gain.controller.gains) text << gain << '\n';
  return text.str();
}

ChosenController controller_from(const std::string& text, const io::Case& antenna) {
  ChosenController fixed_gain;
  std::istringstream lines(text);
  std::getline(lines, fixed_gain.structure);
  std::getline(lines, fixed_gain.source);
  const std::string rest(std::istreambuf_iterator<char>(lines), {});
  if (rest.starts_with('{')) {
    fixed_gain.controller = control::state_space_controller(
        fixed_gain.structure, io::parse_controller(rest, fixed_gain.source, 1.0).system);
    return fixed_gain;
  }
  fixed_gain.controller.structure = io::structure_named(antenna, fixed_gain.structure);
  // Streams do not read hexadecimal numbers.
  std::istringstream numbers(rest);
  for (std::string line; std::getline(numbers, line);)
    fixed_gain.controller.gains.push_back(std::stod(line));
  return fixed_gain;
}

ChosenController make_controller(const MonteCarloArguments& arguments, const Population& population,
                                 const std::function<bool()>& interrupted) {
  const io::Case& antenna = population->antenna;
  if (auto named = named_controller(antenna, arguments.controller)) {
    return std::move(*named);
  }
  design::TuneOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  return recommended_controller(*population, arguments.controller.structure, options);
}

// Works the missing blocks off and keeps the checkpoint fresh.
class Work {
 public:
  Work(const MonteCarloArguments& arguments, Ranks& ranks, design::MonteCarloRun& run,
       std::string_view digest, const std::function<bool()>& interrupted)
      : arguments_(arguments),
        ranks_(ranks),
        run_(run),
        digest_(digest),
        interrupted_(interrupted),
        progress_("evaluating plants") {}

  void run() {
    if (ranks_.size() == 1) {
      run_.work_on(run_.missing_blocks(), {.threads = arguments_.threads,
                                           .stop = interrupted_,
                                           .watch = [&] { look(run_.plants_done()); }});
    } else {
      run_in_rounds();
    }
    save();
  }

 private:
  // Blocks are dealt out round by round: in between rank 0 has them all.
  void run_in_rounds() {
    constexpr std::size_t blocks_a_thread = 16;
    std::vector<std::size_t> missing = blocks_on_all();
    const std::size_t round = ranks_.size() * arguments_.threads * blocks_a_thread;
    for (std::size_t from = 0; from < missing.size(); from += round) {
      std::vector<std::size_t> mine;
      const std::size_t end = std::min(from + round, missing.size());
      for (std::size_t i = from + ranks_.rank(); i < end; i += ranks_.size()) {
        mine.push_back(missing[i]);
      }
      on_all(ranks_, [&] {
        run_.work_on(mine, {.threads = arguments_.threads, .stop = interrupted_, .watch = {}});
      });
      std::erase_if(mine, [&](std::size_t block) { return !run_.whole(block); });
      for (const auto& bytes : ranks_.gather(io::to_bytes(run_, mine))) {
        io::put_blocks(bytes, run_);
      }
      on_all(ranks_, [&] {
        if (ranks_.first()) look(run_.plants_done());
      });
      if (ranks_.any(interrupted_ && interrupted_())) return;
    }
  }

  // Only rank 0 read the checkpoint.
  std::vector<std::size_t> blocks_on_all() {
    std::string whole(run_.blocks(), '0');
    for (std::size_t block = 0; block < whole.size(); ++block) {
      if (run_.whole(block)) whole[block] = '1';
    }
    whole = ranks_.broadcast(whole);
    std::vector<std::size_t> missing;
    for (std::size_t block = 0; block < whole.size(); ++block) {
      if (whole[block] == '0') missing.push_back(block);
    }
    return missing;
  }

  void look(std::uint64_t done) {
    progress_.show(done, run_.study().plants);
    // A long run's checkpoint takes its time to write: a twentieth of all at most.
    constexpr auto every = std::chrono::seconds(3);
    if (Clock::now() - saved_ < every + 20 * saving_) return;
    save();
  }

  void save() {
    if (arguments_.checkpoint_path.empty() || !ranks_.first()) return;
    const auto start = Clock::now();
    io::write_checkpoint(arguments_.checkpoint_path, digest_, run_);
    saved_ = Clock::now();
    saving_ = saved_ - start;
  }

  const MonteCarloArguments& arguments_;
  Ranks& ranks_;
  design::MonteCarloRun& run_;
  std::string_view digest_;
  std::function<bool()> interrupted_;
  ProgressLine progress_;
  // The first after a second: what is lost then is least missed, and least work to keep.
  Clock::time_point saved_ = Clock::now() - std::chrono::seconds(2);
  Clock::duration saving_{};
};

// With controller and case.
MonteCarloSection section_of(design::MonteCarloSummary summary,
                             const MonteCarloArguments& arguments, const io::Case& antenna,
                             const design::MonteCarlo& study, const ChosenController& fixed_gain) {
  MonteCarloSection section;
  static_cast<design::MonteCarloSummary&>(section) = std::move(summary);
  section.case_path = arguments.case_path;
  section.title = antenna.title;
  section.axis = io::pointing_axis(antenna);
  section.seed = arguments.seed;
  section.controller = fixed_gain.controller;
  section.structure = fixed_gain.structure;
  section.controller_source = fixed_gain.source;
  section.gains = io::GainUnits(antenna).texts(fixed_gain.controller);
  section.wind_model = study.problem.wind.model;
  section.wind_speed = study.problem.wind.mean_speed;
  section.assumed = assumed_inputs(antenna, {.time_runs = section.effect.factor != 1.0});
  return section;
}

// Before the work, not after it.
void require_outputs(const MonteCarloArguments& arguments) {
  arguments.outputs.require_writable();
  for (const auto* path : {&arguments.csv_path, &arguments.checkpoint_path}) {
    if (!path->empty()) io::require_writable(*path);
  }
}

}  // namespace

MonteCarloOutcome run_montecarlo(const MonteCarloArguments& arguments, Ranks& ranks,
                                 const std::function<bool()>& interrupted) {
  Population population;
  design::MonteCarlo study;
  ChosenController fixed_gain;
  MonteCarloOutcome outcome;
  std::string controller_text;
  on_all(ranks, [&] {
    if (ranks.first()) require_outputs(arguments);
    io::Case antenna = io::read_case(arguments.case_path);
    if (!arguments.controller.structure.empty()) {
      try {
        io::loop_structure(antenna, arguments.controller.structure);
      } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("--structure: {}", error.what()));
      }
    }
    population = std::make_shared<io::DesignedAntenna>(
        designed_antenna(antenna, arguments.seed, arguments.threads, interrupted));
    if (ranks.first()) {
      fixed_gain = make_controller(arguments, population, interrupted);
      controller_text = controller_bytes(fixed_gain);
    }
  });
  controller_text = ranks.broadcast(controller_text);
  std::string digest;
  on_all(ranks, [&] {
    if (!ranks.first()) fixed_gain = controller_from(controller_text, population->antenna);
    study = monte_carlo_of(
        population->mission, population->distribution, fixed_gain.controller,
        {.plants = arguments.plants, .seed = arguments.seed, .retune = arguments.retune});
    outcome.run = std::make_unique<design::MonteCarloRun>(study);
    if (arguments.checkpoint_path.empty() || !ranks.first()) return;
    digest = io::digest_of(BORESIGHT_VERSION, content_of(arguments.case_path), study,
                           population->distribution, arguments.seed);
    if (io::read_checkpoint(arguments.checkpoint_path, digest, *outcome.run) > 0) {
      fmt::print(stderr, "boresight: {} of {} plants taken up from {}\n",
                 outcome.run->plants_done(), arguments.plants, arguments.checkpoint_path);
    }
  });
  Work work(arguments, ranks, *outcome.run, digest, interrupted);
  work.run();
  outcome.distribution = {population, &population->distribution};
  if (!ranks.first()) return outcome;

  MonteCarloSection& section = outcome.section;
  section = section_of(summarise(*outcome.run, population->mission, *outcome.distribution,
                                 arguments.seed, arguments.threads),
                       arguments, population->antenna, study, fixed_gain);
  section.distribution = source_text(*outcome.distribution);
  section.conclusions = conclude(section);
  std::string warning = resonance_warning(resonance_verdict(*population));
  if (!warning.empty()) {
    section.conclusions.insert(section.conclusions.begin(), std::move(warning));
  }
  section.figures = montecarlo_figures(outcome);
  return outcome;
}

}  // namespace boresight::app
