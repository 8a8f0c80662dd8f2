// Options that select a part of a rendering.
#pragma once
#include <string>

#include "command.h"
#include "render/document.h"

namespace etendue::cli {

// As given on the command line; empty: not given.
struct PartArguments {
  std::string samples, region;

  bool is_given() const { return !samples.empty() || !region.empty(); }
};

CommandOption samples_option(std::string& target);
CommandOption region_option(std::string& target);

// Sets the part and the number of its samples. Without --samples these are the samples from 0 to the document's limit.
// `samples` is the argument of --spp, or 0.
Result<void> apply_part(const PartArguments& arguments, uint32_t samples, render::Document& document);

// Whether the arguments name the part that the document has from a checkpoint, or none.
Result<void> check_resumed_part(const PartArguments& arguments, const render::Document& document);

}  // namespace etendue::cli
