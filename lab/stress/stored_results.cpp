#include "stress/stored_results.h"

#include "job_part/part_file.h"

namespace etendue::stress {
namespace {

using job_part::read_text;
using job_part::write_text;

void write(StateWriter& out, const TestResult& result) {
  write_text(out, result.method);
  write_text(out, result.expectation);
  out.value(result.measured);
  out.value<uint8_t>(result.ok);
  out.value(result.image.width);
  out.value(result.image.height);
  out.list(std::span<const uint8_t>(result.image.rgb));
}

bool read(StateReader& in, TestResult& result) {
  Thumbnail& image = result.image;
  uint8_t ok = 0;
  if (!read_text(in, result.method) || !read_text(in, result.expectation) || !in.value(result.measured) ||
      !in.value(ok) || !in.value(image.width) || !in.value(image.height) || !in.list(image.rgb))
    return false;
  result.ok = ok != 0;
  return image.rgb.empty() || int64_t{3} * image.width * image.height == static_cast<int64_t>(image.rgb.size());
}

bool read(StateReader& in, CaseResult& row) {
  std::string name;
  uint64_t results = 0;
  if (!read_text(in, name) || !in.value(row.seconds) || !in.value(results)) return false;
  row.stress_case = find_case(name);
  for (uint64_t i = 0; i < results; ++i)
    if (!read(in, row.results.emplace_back())) return false;
  return row.stress_case != nullptr;
}

}  // namespace

std::vector<std::byte> bytes_of(const std::vector<CaseResult>& rows) {
  StateWriter out;
  out.value<uint64_t>(rows.size());
  for (const CaseResult& row : rows) {
    write_text(out, row.stress_case->name);
    out.value(row.seconds);
    out.value<uint64_t>(row.results.size());
    for (const TestResult& result : row.results) write(out, result);
  }
  return out.take();
}

std::optional<std::vector<CaseResult>> rows_from(std::span<const std::byte> bytes) {
  StateReader in(bytes);
  uint64_t count = 0;
  if (!in.value(count)) return std::nullopt;
  std::vector<CaseResult> rows;
  for (uint64_t i = 0; i < count; ++i)
    if (!read(in, rows.emplace_back(CaseResult{.stress_case = nullptr, .results = {}}))) return std::nullopt;
  return in.at_end() ? std::optional(std::move(rows)) : std::nullopt;
}

}  // namespace etendue::stress
