// The only file that includes CLI11, which takes long to compile.
#include "parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <type_traits>

#include "base/similar_name.h"
#include "cluster/mpi_job.h"

namespace etendue::cli {
namespace {

template <class T>
struct Element {
  using Type = T;
};
template <class T>
struct Element<std::vector<T>> {
  using Type = T;
};

// Number types decide how the library words its messages.
template <class Number>
void check_bounds(CLI::Option& parsed, const Bounds& bounds) {
  switch (bounds.kind) {
    case Bounds::Kind::none:
      break;
    case Bounds::Kind::positive:
      parsed.check(CLI::PositiveNumber);
      break;
    case Bounds::Kind::non_negative:
      parsed.check(CLI::NonNegativeNumber);
      break;
    case Bounds::Kind::range:
      parsed.check(CLI::Range(static_cast<Number>(bounds.min), static_cast<Number>(bounds.max)));
      break;
  }
}

void add_option(CLI::App& parser, const CommandOption& option) {
  std::visit(
      [&](auto* target) {
        using Target = std::remove_pointer_t<decltype(target)>;
        using Value = typename Element<Target>::Type;
        if constexpr (std::is_same_v<Target, bool>) {
          parser.add_flag(option.names, *target, option.doc);
        } else {
          CLI::Option* parsed = parser.add_option(option.names, *target, option.doc);
          if (option.required) parsed->required();
          if (!option.choices.empty()) parsed->check(CLI::IsMember(option.choices));
          if (!option.needs.empty()) parsed->needs(parser.get_option(option.needs));
          if constexpr (std::is_arithmetic_v<Value>) check_bounds<Value>(*parsed, option.bounds);
          if constexpr (!std::is_same_v<Target, Value>) {
            if (option.count > 0)
              parsed->expected(option.count);
            else
              parsed->take_all();
          }
        }
      },
      option.target);
}

// Names the first argument that no option takes, and the option of the command that was probably meant.
std::string unknown_argument(const CLI::App& app) {
  for (const CLI::App* parser : app.get_subcommands()) {
    const std::vector<std::string> rest = parser->remaining();
    if (rest.empty()) continue;
    const auto option = std::ranges::find_if(rest, [](const std::string& text) { return text.starts_with("-"); });
    if (option == rest.end()) return "'" + rest.front() + "' belongs to no option";
    std::vector<std::string> names;
    for (const CLI::Option* known : parser->get_options())
      for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
    const std::string name = option->substr(0, option->find('='));
    return "there is no option '" + name + "'" + did_you_mean(name, names);
  }
  return "";
}

// All ranks of an MPI job have the same arguments.
int fail_to_parse(const std::string& message) { return fail_on_all_ranks(usage_error(message)); }

// Several processes of a command that does not divide would all do the same work, and overwrite each other's files.
int run_command(const Command& command) {
  if (cluster::launched_ranks() > 1 && !command.supports_ranks)
    return fail_on_all_ranks(usage_error(command.name + ": does not divide among the " +
                                         std::to_string(cluster::launched_ranks()) +
                                         " ranks that mpirun has started; run it without mpirun"));
  return command.run();
}

}  // namespace

bool is_option_without_command(std::string_view argument) {
  constexpr std::array<std::string_view, 3> kOptions{"-h", "--help", "--version"};
  return std::ranges::find(kOptions, argument) != kOptions.end();
}

int parse_and_run(const std::vector<Command>& commands, std::vector<std::string> arguments) {
  CLI::App app{"Étendue: a workbench for light transport", "etendue"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("etendue ") + ETENDUE_VERSION, "Print the version");
  app.footer("etendue [SCENE] opens the viewer.");
  int code = 0;
  for (const Command& command : commands) {
    CLI::App* parser = app.add_subcommand(command.name, command.summary);
    for (const CommandOption& option : command.options) add_option(*parser, option);
    parser->callback([&code, &command] { code = run_command(command); });
  }
  const std::string first = arguments.empty() ? "" : arguments.front();
  const bool is_known = std::ranges::any_of(commands, [&](const Command& command) { return command.name == first; });
  const std::string help = is_known ? "etendue " + first + " --help" : "etendue --help";
  std::ranges::reverse(arguments);  // the order that the library expects
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp& request) {
    return app.exit(request);
  } catch (const CLI::CallForAllHelp& request) {
    return app.exit(request);
  } catch (const CLI::CallForVersion& request) {
    return app.exit(request);
  } catch (const CLI::ExtrasError& error) {
    const std::string unknown = unknown_argument(app);
    const std::string message = unknown.empty() ? error.what() : unknown;
    return fail_to_parse(message + (message.ends_with("?") ? " See " : "; see ") + help);
  } catch (const CLI::ParseError& error) {
    return fail_to_parse(std::string(error.what()) + "; see " + help);
  }
  return code;
}

}  // namespace etendue::cli
