#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/figures/montecarlo_figures.hpp>
#include <boresight/app/montecarlo/checkpoint.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/app/uncertainty/distribution_source.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Clock = std::chrono::steady_clock;

// What plants are drawn from, shared with the function that makes them.
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

// What makes a run this one and no other. Its first plants hold what the case's other files say,
// and the outcome of one what this program makes of it.
std::string digest_of(const MonteCarloArguments& arguments,
                      const design::PlantDistribution& distribution,
                      const design::MonteCarlo& study) {
  std::string all = fmt::format("{}\n{}\n{} {} {} {}\n{}", BORESIGHT_VERSION,
                                content_of(arguments.case_path), arguments.seed, arguments.plants,
                                arguments.retune, study.confirm_every, study.law.structure.name());
  const auto add = [&](double number) { fmt::format_to(std::back_inserter(all), " {}", number); };
  for (const double gain : study.law.gains) add(gain);
  for (std::uint64_t index = 0; index < 8; ++index) {
    for (const double value : distribution.draw(arguments.seed, index).values) add(value);
  }
  const auto outcome = design::MonteCarloJudge(study).judge(0);
  add(outcome.beam_rms);
  add(outcome.valve_effort);
  add(outcome.worst_goal_ratio);
  for (const double peak : outcome.sensitivity_peaks) add(peak);
  return io::sha256_hex(all);
}

// Gains as bytes, so that every rank holds the same law to the last bit.
std::string law_bytes(const ChosenController& held) {
  std::ostringstream text;
  text << held.structure << '\n' << held.source << '\n' << std::hexfloat;
  for (const double gain : held.law.gains) text << gain << '\n';
  return text.str();
}

std::string gains_text(const std::string& text) {
  return text.substr(text.find('\n', text.find('\n') + 1) + 1);
}

ChosenController law_from(const std::string& text, const io::Case& antenna) {
  ChosenController held;
  std::istringstream lines(text);
  std::getline(lines, held.structure);
  std::getline(lines, held.source);
  held.law.structure = structure_named(antenna, held.structure);
  // Streams do not read hexadecimal numbers.
  std::istringstream numbers(gains_text(text));
  for (std::string line; std::getline(numbers, line);) held.law.gains.push_back(std::stod(line));
  return held;
}

ChosenController make_law(const MonteCarloArguments& arguments, const Population& population,
                          const std::function<bool()>& interrupted) {
  const io::Case& antenna = population->antenna;
  if (auto named = named_controller(antenna, arguments.gains, arguments.structure)) {
    return std::move(*named);
  }
  design::TuneOptions options;
  if (!arguments.structure.empty()) {
    options.structures = structure_option(antenna, {arguments.structure});
  }
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  return recommended_controller(*population, options);
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
        progress_("judging plants") {}

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
      for (const auto& bytes : ranks_.gather(to_bytes(run_, mine))) put_blocks(bytes, run_);
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
    write_checkpoint(arguments_.checkpoint_path, digest_, run_);
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

design::MonteCarlo make_study(const MonteCarloArguments& arguments, const Population& population,
                              const control::ControlLaw& law) {
  design::MonteCarlo study;
  const design::Mission& mission = population->mission;
  study.problem = tracking_problem(mission);
  study.problem.climate = mission.climate;
  study.law = law;
  study.goals = constraints(mission);
  study.plants = arguments.plants;
  study.retune = arguments.retune;
  study.retune_over_climate = mission.minimises_climate;
  study.plant = [population, seed = arguments.seed](std::uint64_t index) {
    return linear_plant(changed(population->mission.antenna,
                                changes_of(population->distribution.draw(seed, index))));
  };
  return study;
}

// Law and case of a report; summarise() has the rest.
MonteCarloSection new_section(const MonteCarloArguments& arguments, const io::Case& antenna,
                              const design::MonteCarlo& study, const ChosenController& held) {
  MonteCarloSection section;
  section.case_path = arguments.case_path;
  section.title = antenna.title;
  section.axis = antenna.axis;
  section.seed = arguments.seed;
  section.law = held.law;
  section.structure = held.structure;
  section.law_source = held.source;
  section.gains = io::GainUnits(antenna).texts(held.law);
  section.wind_model = study.problem.wind.model;
  section.wind_speed = study.problem.wind.mean_speed;
  for (const auto& band : make_bands(antenna)) section.losses.push_back({band, {}, {}});
  for (const auto& budget : make_budgets(antenna)) section.budgets.push_back({budget, {}});
  section.assumed = assumed_inputs(antenna);
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
  ChosenController held;
  MonteCarloOutcome outcome;
  std::string law_text;
  on_all(ranks, [&] {
    if (ranks.first()) require_outputs(arguments);
    io::Case antenna = io::read_case(arguments.case_path);
    if (!arguments.structure.empty()) {
      try {
        io::loop_structure(antenna, arguments.structure);
      } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("--structure: {}", error.what()));
      }
    }
    population = std::make_shared<io::DesignedAntenna>(
        designed_antenna(antenna, arguments.seed, arguments.threads, interrupted));
    if (ranks.first()) {
      held = make_law(arguments, population, interrupted);
      law_text = law_bytes(held);
    }
  });
  law_text = ranks.broadcast(law_text);
  std::string digest;
  on_all(ranks, [&] {
    if (!ranks.first()) held = law_from(law_text, population->antenna);
    study = make_study(arguments, population, held.law);
    outcome.run = std::make_unique<design::MonteCarloRun>(study);
    if (arguments.checkpoint_path.empty() || !ranks.first()) return;
    digest = digest_of(arguments, population->distribution, study);
    if (read_checkpoint(arguments.checkpoint_path, digest, *outcome.run) > 0) {
      fmt::print(stderr, "boresight: {} of {} plants taken up from {}\n",
                 outcome.run->plants_done(), arguments.plants, arguments.checkpoint_path);
    }
  });
  Work work(arguments, ranks, *outcome.run, digest, interrupted);
  work.run();
  outcome.distribution = {population, &population->distribution};
  if (!ranks.first()) return outcome;

  MonteCarloSection& section = outcome.section;
  section = new_section(arguments, population->antenna, study, held);
  summarise(*outcome.run, *outcome.distribution, arguments.seed, section);
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
