#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commands/completion_scripts.hpp>

namespace boresight::app {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> option_names(const std::vector<OptionText>& options) {
  std::vector<std::string> names;
  for (const auto& option : options) {
    if (!option.argument) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::vector<std::string> command_names(const ProgramText& program) {
  std::vector<std::string> names;
  for (const auto& command : program.commands) names.push_back(command.name);
  return names;
}

// With a character before each of those that mean something to the shell.
std::string escaped(std::string_view text, std::string_view special, std::string_view before) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += before;
    result += c;
  }
  return result;
}

// Inside single quotes, where a quote ends the text, stands escaped and begins it again.
std::string single_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// A line of the bash function's table of what an option's value may be: `set words` or `files`.
std::string bash_value(const OptionText& option) {
  std::string set = fmt::format("words='{}'", joined(option.words));
  if (option.files == ValueFiles::files) set += " files=-f";
  if (option.files == ValueFiles::folders) set += " files=-d";
  return set;
}

std::string zsh_action(const OptionText& option) {
  if (!option.words.empty()) return fmt::format("({})", joined(option.words));
  if (option.files == ValueFiles::files) return "_files";
  if (option.files == ValueFiles::folders) return "_files -/";
  return " ";
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
  std::string values, options, arguments;
  for (const auto& command : program.commands) {
    OptionText argument;
    for (const auto& option : command.options) {
      if (option.argument) {
        argument.words.insert(argument.words.end(), option.words.begin(), option.words.end());
        if (argument.files == ValueFiles::none) argument.files = option.files;
      } else if (!option.value.empty()) {
        // Of an option with one value only the word behind it.
        values += fmt::format("    \"{} {} \"{}) {} ;;\n", command.name, option.names.back(),
                              option.several ? "*" : "1", bash_value(option));
      }
    }
    options +=
        fmt::format("    {}) words='{}' ;;\n", command.name, joined(option_names(command.options)));
    if (!argument.words.empty() || argument.files != ValueFiles::none) {
      arguments += fmt::format("        {}) {} ;;\n", command.name, bash_value(argument));
    }
  }
  const auto commands = command_names(program);
  return fmt::format(R"bash(# Completion of boresight for bash: source this file.
_boresight() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} command='' option='' words='' files='' i from=0
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      -*) option=${{COMP_WORDS[i]}} from=$i ;;
      {}) [ -n "$command" ] || command=${{COMP_WORDS[i]}} ;;
    esac
  done
  case "$command $option $((COMP_CWORD - from))" in
{}    *) option='' ;;
  esac
  if [ -z "$option" ] || [[ $current == -* ]]; then
    words='' files=''
    if [[ $current == -* ]]; then
      case $command in
        '') words='{}' ;;
{}      esac
    else
      case $command in
        '') words='{}' ;;
{}      esac
    fi
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [ -n "$files" ]; then
    compopt -o filenames 2>/dev/null
    local found
    mapfile -t found < <(compgen "$files" -- "$current")
    COMPREPLY+=("${{found[@]}}")
  fi
}}
complete -F _boresight boresight
)bash",
                     joined(commands, " | "), values, joined(option_names(program.options)),
                     options, joined(commands), arguments);
}

std::string zsh_completion(const ProgramText& program) {
  std::string commands, cases;
  const auto described = [](std::string_view text) { return escaped(text, "[]:\\", "\\"); };
  for (const auto& command : program.commands) {
    commands +=
        fmt::format("    {}\n", single_quoted(command.name + ":" + described(command.description)));
    std::string arguments;
    for (const auto& option : command.options) {
      std::string spec;
      if (option.argument) {
        spec = fmt::format("{}:{}:{}", option.several ? "*" : "", option.names.back(),
                           zsh_action(option));
        arguments += fmt::format(" \\\n        {}", single_quoted(spec));
        continue;
      }
      for (const auto& name : option.names) {
        spec =
            fmt::format("{}{}[{}]", option.several ? "*" : "", name, described(option.description));
        if (!option.value.empty()) {
          spec += fmt::format(":{}:{}", described(option.value), zsh_action(option));
        }
        arguments += fmt::format(" \\\n        {}", single_quoted(spec));
      }
    }
    cases += fmt::format("    {})\n      _arguments{}\n      ;;\n", command.name, arguments);
  }
  return fmt::format(R"zsh(#compdef boresight
# Completion of boresight for zsh: keep this file as _boresight in a folder of fpath.
_boresight() {{
  local -a commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{}  esac
}}
if [ "$funcstack[1]" = _boresight ]; then
  _boresight "$@"
else
  compdef _boresight boresight
fi
)zsh",
                     commands, cases);
}

std::string fish_completion(const ProgramText& program) {
  std::string script = "# Completion of boresight for fish.\ncomplete -c boresight -f\n";
  const auto add = [&](const std::string& condition, const OptionText& option) {
    std::string line = fmt::format("complete -c boresight -n {}", single_quoted(condition));
    if (!option.argument) {
      for (const auto& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (!option.value.empty()) line += " -r";
    }
    if (option.files == ValueFiles::files) line += " -F";
    if (option.files == ValueFiles::folders) line += " -a '(__fish_complete_directories)'";
    if (!option.words.empty()) line += fmt::format(" -a {}", single_quoted(joined(option.words)));
    script += fmt::format("{} -d {}\n", line, single_quoted(option.description));
  };
  for (const auto& option : program.options) add("__fish_use_subcommand", option);
  for (const auto& command : program.commands) {
    script += fmt::format("complete -c boresight -n __fish_use_subcommand -a {} -d {}\n",
                          command.name, single_quoted(command.description));
    for (const auto& option : command.options) {
      add("__fish_seen_subcommand_from " + command.name, option);
    }
  }
  return script;
}

}  // namespace boresight::app
