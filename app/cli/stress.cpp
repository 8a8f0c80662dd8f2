// etendue stress: every case where a method is known to fail, what should happen, what did.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "command.h"
#include "stress/case.h"
#include "stress/matrix.h"

namespace etendue::cli {
namespace {

struct Options {
  std::vector<std::string> names;
  std::string out;
  stress::TestOptions test;
  bool list = false, json = false;
};

void print_list() {
  for (const stress::Case& c : stress::cases())
    std::printf("%-30s %s\n  %s\n", c.name, std::string(stress::kind_name(c.kind)).c_str(), c.theory);
}

void print_row(const stress::CaseResult& row) {
  size_t failed = 0;
  for (const auto& f : row.results) failed += f.ok ? 0 : 1;
  std::printf("%-4s %-30s %3zu of %3zu  %6.1f s\n", failed ? "FAIL" : "ok", row.stress_case->name,
              row.results.size() - failed, row.results.size(), row.seconds);
  for (const auto& f : row.results)
    if (!f.ok)
      std::printf("       %s: expected %s, measured %s\n", f.method.c_str(), f.expectation.c_str(),
                  stress::number(f.measured).c_str());
  std::fflush(stdout);
}

Result<std::vector<const stress::Case*>> chosen(const std::vector<std::string>& names) {
  std::vector<const stress::Case*> list;
  for (const auto& name : names) {
    const stress::Case* found = stress::find_case(name);
    if (!found) return usage_error("no case is called '" + name + "'; see etendue stress --list");
    list.push_back(found);
  }
  if (names.empty())
    for (const stress::Case& c : stress::cases()) list.push_back(&c);
  return list;
}

Result<void> write(const std::filesystem::path& folder, const std::vector<stress::CaseResult>& rows) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const std::pair<const char*, std::string> files[] = {{"matrix.json", stress::matrix_json(rows)},
                                                       {"matrix.html", stress::matrix_html(rows)}};
  for (const auto& [name, text] : files)
    if (auto ok = write_file(folder / name, text.data(), text.size()); !ok) return ok;
  return {};
}

int run(const Options& o) {
  if (o.list) return print_list(), 0;
  const auto list = chosen(o.names);
  if (!list) return fail(list.error());
  std::vector<stress::CaseResult> rows;
  size_t results = 0, failed = 0;
  for (const stress::Case* c : *list) {
    rows.push_back(stress::run(*c, o.test));
    if (!o.json) print_row(rows.back());
    for (const auto& f : rows.back().results) ++results, failed += f.ok ? 0 : 1;
  }
  if (!o.out.empty())
    if (auto ok = write(o.out, rows); !ok) return fail(ok.error());
  if (o.json)
    std::printf("%s\n", stress::matrix_json(rows).c_str());
  else
    std::printf("%zu cases, %zu expectations, %zu not met\n", rows.size(), results, failed);
  return failed ? 1 : 0;
}

}  // namespace

Command add_stress(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("case", o->names, "Cases by name; all without");
  app.add_flag("--list", o->list, "Say what cases there are, and run none");
  app.add_flag("--json", o->json, "Print JSON");
  app.add_option("--out", o->out, "A folder for matrix.json and matrix.html with pictures");
  app.add_option("--seed", o->test.seed, "Another seed is independent noise");
  app.add_option("--threads", o->test.threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_option("--size", o->test.size, "Width and height of the small pictures, pixels")->check(CLI::Range(8, 512));
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
