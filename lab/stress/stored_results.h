// Results of cases as the content of a part (job_part/part_file.h).
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "stress/matrix.h"

namespace etendue::stress {

std::vector<std::byte> bytes_of(const std::vector<CaseResult>& rows);
// Nothing if the bytes are damaged, or if a case does not exist.
std::optional<std::vector<CaseResult>> rows_from(std::span<const std::byte> bytes);

}  // namespace etendue::stress
