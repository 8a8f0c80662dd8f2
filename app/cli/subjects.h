// What the commands bsdf and phase have in common: they analyse one subject, or two for comparison (--against).
#pragma once
#include <cstdio>
#include <string>
#include <vector>

#include "base/json_text.h"
#include "base/result.h"
#include "json.h"

namespace etendue::cli {

struct NamedSettings {
  std::string name;
  std::vector<std::string> settings;  // NAME=VALUE
};

// One subject, or two if the second one has a name. `make` returns a Result<Subject>.
template <class Subject, class Make>
Result<std::vector<Subject>> make_subjects(const NamedSettings& first, const NamedSettings& second, Make&& make) {
  std::vector<Subject> subjects;
  for (const NamedSettings* settings : {&first, &second}) {
    if (settings == &second && second.name.empty()) continue;
    auto subject = make(*settings);
    if (!subject) return subject.error();
    subjects.push_back(std::move(*subject));
  }
  return subjects;
}

// Prints the description of one subject, or an array of two. Returns the exit code 0.
template <class Subject, class ToJson>
int print_json_of(const std::vector<Subject>& subjects, ToJson&& to_json) {
  json list = json::array();
  for (const Subject& subject : subjects) list.push_back(to_json(subject));
  std::printf("%s\n", json_text(subjects.size() == 1 ? list[0] : list, 2).c_str());
  return 0;
}

}  // namespace etendue::cli
