// etendue completion: scripts with which a shell completes commands, options and names.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.h"
#include "integrator/integrator.h"
#include "sampling/sampler.h"
#include "scene/builtin/builtin.h"

namespace etendue::cli {
namespace {

struct CompletionArguments {
  std::string shell;
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> names_of(const CommandOption& option) {
  std::vector<std::string> names;
  for (size_t start = 0; start < option.names.size();) {
    const size_t end = std::min(option.names.find(',', start), option.names.size());
    names.push_back(option.names.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

bool is_positional(const CommandOption& option) { return !option.names.starts_with("-"); }
bool is_flag(const CommandOption& option) { return std::holds_alternative<bool*>(option.target); }

// The known values of an option; empty: a file name or any text.
std::vector<std::string> values_of(const CommandOption& option) {
  std::vector<std::string> values = option.choices;
  if (option.names == "scene")
    for (const auto& builtin : scene::builtins()) values.emplace_back(builtin.name);
  if (option.names == "--integrator")
    for (const auto& info : integrator::integrator_infos()) values.emplace_back(info.name);
  if (option.names == "--sampler")
    for (const auto& info : sampler_infos()) values.emplace_back(info.name);
  return values;
}

// What can stand at the beginning of a word: the names of options, and values of positional arguments.
std::vector<std::string> words_of(const Command& command) {
  std::vector<std::string> words;
  for (const CommandOption& option : command.options)
    std::ranges::copy(is_positional(option) ? values_of(option) : names_of(option), std::back_inserter(words));
  words.emplace_back("--help");
  return words;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return names;
}

std::string bash_script() {
  std::string values, words;
  for (const Command& command : commands()) {
    words += "    " + command.name + ") words=\"" + joined(words_of(command)) + "\" ;;\n";
    for (const CommandOption& option : command.options) {
      const auto known = values_of(option);
      if (is_positional(option) || known.empty()) continue;
      for (const std::string& name : names_of(option))
        values += "    " + command.name + ":" + name + ") COMPREPLY=($(compgen -W \"" + joined(known) +
                  "\" -- \"$word\")); return ;;\n";
    }
  }
  return "_etendue() {\n"
         "  local word=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
         "  local command=\"${COMP_WORDS[1]}\" words=\"\"\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         joined(command_names()) +
         " --help --version\" -- \"$word\") $(compgen -f -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case \"$command:$previous\" in\n" +
         values +
         "  esac\n"
         "  case \"$command\" in\n" +
         words +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\") $(compgen -f -- \"$word\"))\n"
         "}\n"
         "complete -o filenames -F _etendue etendue\n";
}

std::string zsh_script() { return "autoload -U +X bashcompinit && bashcompinit\n" + bash_script(); }

// A text in single quotes for fish.
std::string fish_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += (c == '\'' || c == '\\') ? std::string("\\") + c : std::string(1, c);
  return quoted + "'";
}

std::string fish_option(const Command& command, const CommandOption& option) {
  const auto known = values_of(option);
  std::string line = "complete -c etendue -n '__fish_seen_subcommand_from " + command.name + "'";
  if (is_positional(option)) return known.empty() ? "" : line + " -a " + fish_quoted(joined(known)) + "\n";
  for (const std::string& name : names_of(option))
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!is_flag(option)) line += " -r";
  if (!known.empty()) line += " -f -a " + fish_quoted(joined(known));
  return line + " -d " + fish_quoted(option.doc) + "\n";
}

std::string fish_script() {
  std::string text;
  for (const Command& command : commands()) {
    text += "complete -c etendue -n __fish_use_subcommand -a " + command.name + " -d " + fish_quoted(command.summary) +
            "\n";
    for (const CommandOption& option : command.options) text += fish_option(command, option);
  }
  return text;
}

int run_completion(const CompletionArguments& a) {
  const std::string script = a.shell == "bash" ? bash_script() : a.shell == "zsh" ? zsh_script() : fish_script();
  std::fputs(script.c_str(), stdout);
  return 0;
}

}  // namespace

Command completion_command() {
  const auto a = std::make_shared<CompletionArguments>();
  return {.name = "completion",
          .summary = "Print a script with which the shell completes commands and options",
          .options = {{.names = "shell",
                       .target = &a->shell,
                       .doc = "The shell. For bash: eval \"$(etendue completion bash)\"",
                       .required = true,
                       .choices = {"bash", "zsh", "fish"}}},
          .run = [a] { return run_completion(*a); }};
}

}  // namespace etendue::cli
