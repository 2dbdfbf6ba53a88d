#include <map>

#include <fmt/format.h>

#include <boresight/app/commands/command_examples.hpp>

namespace boresight::app {
namespace {

using Examples = std::vector<CommandExample>;

const std::map<std::string, Examples, std::less<>>& all_examples() {
  static const std::map<std::string, Examples, std::less<>> examples{
      {"",
       {{"boresight new my-antenna", "a case file to fill in, my-antenna/case.toml"},
        {"boresight redesign my-antenna/case.toml", "the whole report"},
        {"boresight tune --help", "options of a command"}}},
      {"redesign",
       {{"boresight redesign case.toml", "the whole report as text"},
        {"boresight redesign case.toml --json report.json", "and as JSON"},
        {"boresight redesign case.toml --seed 2 --threads 4",
         "other random starts: the conclusions should not change"}}},
      {"audit",
       {{"boresight audit case.toml", "inconsistencies of the case"},
        {"boresight audit case.toml --json -", "the same as JSON, to standard output"}}},
      {"identify",
       {{"boresight identify case.toml", "inertia by each method that the case has data for"},
        {"boresight identify case.toml --seed 7 --json drive.json",
         "with other samples of uncertain inputs; the report to a file"}}},
      {"model",
       {{"boresight model case.toml", "parameters, poles and modes of the linear plant"},
        {"boresight model case.toml --json - --quiet", "for a program"}}},
      {"tune",
       {{"boresight tune case.toml", "every structure of the case's [tuning]"},
        {"boresight tune case.toml --structure PI DPF+C", "these two"},
        {"boresight tune case.toml --structure PI --goal gain_margin='8 dB' --speed '12 m/s'",
         "with another specification and wind speed"}}},
      {"match",
       {{"boresight match case.toml --structure PI DPF+C", "two structures, 25 motor inertias"},
        {"boresight match case.toml --points 9 --nominal --no-variants --time-domain none",
         "a quick look"}}},
      {"evaluate",
       {{"boresight evaluate case.toml half.toml none.toml",
         "two proposals compared with the present antenna"},
        {"boresight evaluate case.toml half.toml --structure PI DPF+C --draws 10000",
         "each with the better of two structures, probabilities to 1 %"}}},
      {"montecarlo",
       {{"boresight montecarlo case.toml --structure PI",
         "the robust PI controller on 10 000 plants"},
        {"boresight montecarlo case.toml --gains case --plants 100000 --csv plants.csv",
         "the present gains; every plant to a file"},
        {"boresight montecarlo case.toml --plants 1000000 --checkpoint run.checkpoint",
         "a long run that resumes from the file"}}},
      {"benchmark",
       {{"boresight benchmark case.toml", "the recommended controller"},
        {"boresight benchmark case.toml --controller mine.mat --compare score.json",
         "another controller, compared with the score sheet of an earlier --json"},
        {"boresight benchmark case.toml --gains new.toml --before old/*.csv --after new/*.csv "
         "--change-record change.html",
         "records before and after a change compared at equal wind"}}},
      {"commission",
       {{"boresight commission case.toml --folder plan",
         "a staged plan to the recommended controller, with sheets to fill in"},
        {"boresight commission case.toml --gains gains.toml --record 1 stage1.csv",
         "the record of a stage evaluated"},
        {"boresight commission case.toml --before spring --after autumn",
         "two records of the case compared"}}},
      {"export",
       {{"boresight export case.toml", "the recommended controller in every language"},
        {"boresight export case.toml --gains case --language c --precision single --folder code",
         "the present gains in C, single precision"}}},
      {"simulate",
       {{"boresight simulate case.toml slosh slow-ramp --folder records",
         "two tests; records/slosh.csv and records/slow-ramp.csv"},
        {"boresight simulate case.toml tracking --seed 2 --sample-rate 100",
         "tracking in another wind, sampled at 100 Hz"}}},
      {"new",
       {{"boresight new my-antenna", "my-antenna/case.toml, with its blanks"},
        {"boresight new sites/25-m", "in another folder"}}},
      {"completion",
       {{"source <(boresight completion bash)", "for this session of bash"},
        {"boresight completion zsh > ~/.zfunc/_boresight", "for zsh, where fpath has ~/.zfunc"},
        {"boresight completion fish > ~/.config/fish/completions/boresight.fish", "for fish"}}},
      {"man",
       {{"boresight man | man -l -", "read the manual"},
        {"boresight man > boresight.1", "keep it"}}},
      {"schema",
       {{"boresight schema benchmark", "of the score sheets of boresight benchmark"},
        {"boresight schema simulation > simulation.schema.json", "keep it"}}}};
  return examples;
}

}  // namespace

const std::vector<CommandExample>& command_examples(std::string_view command) {
  static const Examples none;
  const auto found = all_examples().find(command);
  return found == all_examples().end() ? none : found->second;
}

std::string examples_text(std::string_view command) {
  std::string text;
  for (const auto& [call, purpose] : command_examples(command)) {
    text += fmt::format("{}  {}\n      {}\n", text.empty() ? "Examples:\n" : "", call, purpose);
  }
  return text;
}

}  // namespace boresight::app
