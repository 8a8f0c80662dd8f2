// etendue stress: runs the cases in which methods are known to fail and compares the results with the expectations.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "command.h"
#include "job_parts.h"
#include "scene_options.h"
#include "stress/case.h"
#include "stress/matrix.h"
#include "stress/stored_results.h"

namespace etendue::cli {
namespace {

struct StressArguments {
  std::vector<std::string> names;
  std::string out, part;
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

using Rows = std::vector<stress::CaseResult>;

// Prints the number of expectations and returns the exit code.
int print_total(const Rows& rows) {
  size_t expectations = 0, failed = 0;
  for (const stress::CaseResult& row : rows) {
    expectations += row.results.size();
    failed += failures(row);
  }
  std::printf("%zu cases, %zu expectations, %zu not met\n", rows.size(), expectations, failed);
  return failed ? 1 : 0;
}

bool any_failure(const Rows& rows) {
  return std::ranges::any_of(rows, [](const stress::CaseResult& row) { return failures(row) > 0; });
}

// Runs the cases of a part. Whether expectations are met is for the merged results to say.
int run_part(const StressArguments& a, const std::vector<const stress::Case*>& cases) {
  if (a.out.empty()) return fail(usage_error("stress --part: give a folder for the part with --out"));
  if (a.json) return fail(usage_error("stress --part: a part has no --json; matrix.json is written by etendue merge"));
  const auto share = job_part::parse_share(a.part);
  if (!share) return fail(share.error());
  const auto path = job_part::new_part_path(a.out, *share);
  if (!path) return fail(path.error());
  job_part::Part part{{.job = "stress", .version = ETENDUE_VERSION, .share = *share}, {}};
  std::string names;
  Rows rows;
  for (size_t i = 0; i < cases.size(); ++i) {
    names += (i > 0 ? " " : "") + std::string(cases[i]->name);
    if (!share->has(i)) continue;
    rows.push_back(stress::run(*cases[i], a.test));
    print_row(rows.back());
  }
  part.header.settings = {
      {"--seed", std::to_string(a.test.seed)}, {"--size", std::to_string(a.test.size)}, {"the list of cases", names}};
  part.content = stress::bytes_of(rows);
  if (auto ok = job_part::write_part(*path, part); !ok) return fail(ok.error());
  std::printf("%s: %zu of %zu cases\n", path->c_str(), rows.size(), cases.size());
  return 0;
}

int run_stress(const StressArguments& a) {
  if (a.list) {
    print_list();
    return 0;
  }
  const auto cases = select_cases(a.names);
  if (!cases) return fail(cases.error());
  if (!a.part.empty()) return run_part(a, *cases);
  if (!a.out.empty())
    if (auto ok = create_folder(a.out); !ok) return fail(ok.error());
  Rows rows;
  for (const stress::Case* c : *cases) {
    rows.push_back(stress::run(*c, a.test));
    if (!a.json) print_row(rows.back());
  }
  if (!a.out.empty())
    if (auto ok = write_matrix(a.out, rows); !ok) return fail(ok.error());
  if (!a.json) return print_total(rows);
  std::printf("%s\n", stress::matrix_json(rows).c_str());
  return any_failure(rows) ? 1 : 0;
}

}  // namespace

int merge_stress(const job_part::PartSet& parts, const std::string& folder) {
  std::vector<Rows> rows_of_part;
  size_t count = 0;
  for (const auto& file : parts.files) {
    const auto part = job_part::read_part(file);
    if (!part) return fail(part.error());
    auto rows = stress::rows_from(part->content);
    if (!rows) return fail(job_part::damaged(file));
    count += rows->size();
    rows_of_part.push_back(std::move(*rows));
  }
  // Cases are distributed in turn (job_part::Share::has).
  Rows rows;
  for (size_t i = 0; i < count; ++i) {
    Rows& from = rows_of_part[i % rows_of_part.size()];
    const size_t index = i / rows_of_part.size();
    if (index >= from.size()) return fail(job_part::damaged(parts.files[i % rows_of_part.size()]));
    rows.push_back(std::move(from[index]));
  }
  if (auto ok = create_folder(folder); !ok) return fail(ok.error());
  if (auto ok = write_matrix(folder, rows); !ok) return fail(ok.error());
  for (const stress::CaseResult& row : rows) print_row(row);
  return print_total(rows);
}

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
                      part_option(a->part),
                      seed_option(a->test.seed),
                      threads_option(a->test.threads),
                      {.names = "--size",
                       .target = &a->test.size,
                       .doc = "Width and height of the rendered images in pixels (32)",
                       .bounds = between(8, 512)}},
          .run = [a] { return run_stress(*a); }};
}

}  // namespace etendue::cli
