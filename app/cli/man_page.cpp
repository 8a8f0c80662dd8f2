#include "man_page.h"

#include "command.h"

namespace etendue::cli {
namespace {

// Plain text for troff: backslashes and hyphens are escaped, and a line does not begin with a control character.
std::string troff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string line_of(const std::string& text) { return troff(text) + (text.ends_with('.') ? "\n" : ".\n"); }

std::string option_entry(const CommandOption& option) {
  std::string text = ".TP\n.B " + troff(option.names) + "\n" + line_of(option.doc);
  if (option.choices.empty()) return text;
  text += "One of";
  for (const std::string& choice : option.choices) text += (text.ends_with("of") ? " " : ", ") + troff(choice);
  return text + ".\n";
}

std::string command_entry(const Command& command) {
  std::string text = ".SS etendue " + troff(command.name) + "\n" + line_of(command.summary);
  for (const CommandOption& option : command.options) text += option_entry(option);
  return text;
}

}  // namespace

std::string man_page() {
  std::string text =
      ".\\\" Made from the program by tools/update_manual.sh; do not edit.\n"
      ".TH ETENDUE 1 \"\" \"etendue " ETENDUE_VERSION "\" \"User Commands\"\n"
      ".SH NAME\netendue \\- interactive and measured light transport\n"
      ".SH SYNOPSIS\n.B etendue\n[\\fISCENE\\fR]\n.br\n.B etendue\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n"
      "Without a command, etendue opens the viewer with a glTF scene, a session, a snapshot or a built\\-in scene.\n"
      "The commands do the same work without a display.\n"
      ".SH COMMANDS\n";
  for (const Command& command : commands()) text += command_entry(command);
  return text +
         ".SH EXIT STATUS\n0 done; 1 an expectation failed; 2 wrong usage; 3 an input that cannot be used; 4 an output that "
         "cannot be written; 130 interrupted, after saving what there is.\n";
}

}  // namespace etendue::cli
