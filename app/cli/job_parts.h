// Parts of the commands bench, stress and figure --all: options, and merging by etendue merge.
#pragma once
#include <string>

#include "command.h"
#include "job_part/part_file.h"

namespace etendue::cli {

CommandOption part_option(std::string& target);

// Writes the results of a complete set of parts into a folder, as one process does. Returns the exit code.
int merge_bench(const job_part::PartSet& parts, const std::string& folder);
int merge_stress(const job_part::PartSet& parts, const std::string& folder);
int merge_figures(const job_part::PartSet& parts, const std::string& folder);

// Merges parts of any of these commands. Returns the exit code.
int merge_job_parts(const std::vector<std::string>& files, const std::string& folder);

// The value of a setting of a part; empty if it has none.
std::string setting_of(const job_part::Settings& settings, const std::string& name);
// The numbers in such values. They are those that the program wrote, unless the file is not from it.
double number_of(const std::string& text);
uint64_t integer_of(const std::string& text);

}  // namespace etendue::cli
