// etendue stress: runs the cases in which methods are known to fail and compares the results with the expectations.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "command.h"
#include "scene_options.h"
#include "stress/case.h"
#include "stress/matrix.h"

namespace etendue::cli {
namespace {

struct StressArguments {
  std::vector<std::string> names;
  std::string out;
  stress::TestOptions test;
  bool list = false, json = false;
};

void print_list() {
  for (const stress::Case& c : stress::cases())
    std::printf("%-30s %s\n  %s\n", c.name, std::string(stress::kind_name(c.kind)).c_str(), c.theory);
}

size_t failures(const stress::CaseResult& row) {
  size_t count = 0;
  for (const auto& f : row.results) count += f.ok ? 0 : 1;
  return count;
}

void print_row(const stress::CaseResult& row) {
  const size_t failed = failures(row);
  std::printf("%-4s %-30s %3zu of %3zu  %6.1f s\n", failed ? "FAIL" : "ok", row.stress_case->name,
              row.results.size() - failed, row.results.size(), row.seconds);
  for (const auto& f : row.results)
    if (!f.ok)
      std::printf("       %s: expected %s, measured %s\n", f.method.c_str(), f.expectation.c_str(),
                  stress::number(f.measured).c_str());
  std::fflush(stdout);
}

// The cases of these names, or all of them without names.
Result<std::vector<const stress::Case*>> select_cases(const std::vector<std::string>& names) {
  std::vector<const stress::Case*> list;
  for (const auto& name : names) {
    const stress::Case* found = stress::find_case(name);
    if (!found) return usage_error("stress: there is no case '" + name + "'; see etendue stress --list");
    list.push_back(found);
  }
  if (names.empty())
    for (const stress::Case& c : stress::cases()) list.push_back(&c);
  return list;
}

Result<void> create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return check_writable(folder / "matrix.json");
  return output_error(folder.string() + ": the folder cannot be created: " + error.message());
}

Result<void> write_matrix(const std::filesystem::path& folder, const std::vector<stress::CaseResult>& rows) {
  const std::pair<const char*, std::string> files[] = {{"matrix.json", stress::matrix_json(rows)},
                                                       {"matrix.html", stress::matrix_html(rows)}};
  for (const auto& [name, text] : files)
    if (auto ok = write_file(folder / name, text.data(), text.size()); !ok) return ok;
  return {};
}

int run_stress(const StressArguments& a) {
  if (a.list) {
    print_list();
    return 0;
  }
  const auto cases = select_cases(a.names);
  if (!cases) return fail(cases.error());
  if (!a.out.empty())
    if (auto ok = create_folder(a.out); !ok) return fail(ok.error());
  std::vector<stress::CaseResult> rows;
  size_t expectations = 0, failed = 0;
  for (const stress::Case* c : *cases) {
    rows.push_back(stress::run(*c, a.test));
    if (!a.json) print_row(rows.back());
    expectations += rows.back().results.size();
    failed += failures(rows.back());
  }
  if (!a.out.empty())
    if (auto ok = write_matrix(a.out, rows); !ok) return fail(ok.error());
  if (a.json)
    std::printf("%s\n", stress::matrix_json(rows).c_str());
  else
    std::printf("%zu cases, %zu expectations, %zu not met\n", rows.size(), expectations, failed);
  return failed ? 1 : 0;
}

}  // namespace

Command stress_command() {
  const auto a = std::make_shared<StressArguments>();
  return {.name = "stress",
          .summary = "Run the cases in which methods are known to fail and check the expectations",
          .options = {{.names = "case", .target = &a->names, .doc = "Names of cases; default: all"},
                      {.names = "--list", .target = &a->list, .doc = "Print the cases without running them"},
                      json_flag(a->json),
                      {.names = "--out",
                       .target = &a->out,
                       .doc = "Folder for matrix.json and matrix.html, a report with images"},
                      seed_option(a->test.seed),
                      threads_option(a->test.threads),
                      {.names = "--size",
                       .target = &a->test.size,
                       .doc = "Width and height of the rendered images in pixels (32)",
                       .bounds = between(8, 512)}},
          .run = [a] { return run_stress(*a); }};
}

}  // namespace etendue::cli
