#include "job_parts.h"

#include <algorithm>
#include <cstdlib>

namespace etendue::cli {

CommandOption part_option(std::string& target) {
  return {
      .names = "--part",
      .target = &target,
      .doc =
          "Compute only part K of N, as K/N, and write it into the folder of --out. etendue merge makes the results "
          "from all parts"};
}

int merge_job_parts(const std::vector<std::string>& files, const std::string& folder) {
  const auto parts = job_part::complete_set(files, ETENDUE_VERSION);
  if (!parts) return fail(parts.error());
  const std::string& job = parts->header.job;
  if (job == "bench") return merge_bench(*parts, folder);
  if (job == "stress") return merge_stress(*parts, folder);
  if (job == "figure") return merge_figures(*parts, folder);
  return fail(input_error(files[0] + ": is a part of an unknown command, '" + job + "'"));
}

std::string setting_of(const job_part::Settings& settings, const std::string& name) {
  const auto found = std::ranges::find(settings, name, &job_part::Settings::value_type::first);
  return found == settings.end() ? "" : found->second;
}

double number_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }
uint64_t integer_of(const std::string& text) { return std::strtoull(text.c_str(), nullptr, 10); }

}  // namespace etendue::cli
