// Names of classes are expressions that part the paths; energies per class do not depend on threads.
#include "transport/path_classes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "transport/path_expression.h"

namespace etendue::transport {
namespace {

std::vector<Event> events(const std::string& word) {
  std::vector<Event> list;
  for (const char c : word) list.push_back(static_cast<Event>(kLetters.find(c)));
  return list;
}

std::string name_of(const std::string& scattering, Naming naming, size_t detail) {
  return PathClass::of(events(scattering), naming, detail).name();
}

std::vector<std::string> words_up_to(size_t longest) {
  std::vector<std::string> words{""};
  for (size_t i = 0; i < words.size(); ++i)
    for (const char c : {'D', 'G', 'S'})
      if (words[i].size() < longest) words.push_back(words[i] + c);
  return words;
}

TEST(PathClass, Names) {
  EXPECT_EQ(name_of("", Naming::words, 3), "EL");
  EXPECT_EQ(name_of("DSS", Naming::words, 3), "EDSSL");
  EXPECT_EQ(name_of("DSSG", Naming::words, 3), "EDSS.+L");
  EXPECT_EQ(name_of("D", Naming::words, 0), "E.+L");
  EXPECT_EQ(name_of("DSS", Naming::runs, 3), "ED+S+L");
  EXPECT_EQ(name_of("SSSD", Naming::runs, 1), "ES+(D|G).*L");
  EXPECT_EQ(name_of("G", Naming::runs, 0), "E.+L");
}

TEST(PathClass, EveryPathMatchesTheNameOfItsOwnClassAndNoOther) {
  const auto words = words_up_to(6);
  for (const Naming naming : {Naming::words, Naming::runs})
    for (const size_t detail : {0U, 1U, 2U, 3U, 4U}) {
      std::map<std::string, PathExpression> classes;
      for (const auto& word : words) {
        const std::string name = name_of(word, naming, detail);
        auto e = PathExpression::parse_paths(name);
        ASSERT_TRUE(e) << name << e.error().message;
        classes.emplace(name, *e);
      }
      for (const auto& word : words) {
        const std::string own = name_of(word, naming, detail);
        for (const auto& [name, expression] : classes)
          ASSERT_EQ(expression.matches("E" + word + "L"), name == own) << word << ' ' << name;
      }
    }
}

struct Found {
  std::string scattering;
  double energy;
};
using Samples = std::vector<std::vector<Found>>;

Samples random_samples(size_t count) {
  std::mt19937 random(17);
  const auto words = words_up_to(4);
  Samples samples(count);
  for (auto& sample : samples)
    for (unsigned i = random() % 6; i > 0; --i)
      sample.push_back({words[random() % words.size()], std::exp(static_cast<double>(random() % 1000) / 50 - 10)});
  return samples;
}

void fill(ClassEnergies& table, const std::vector<Found>& sample) {
  for (const auto& found : sample) table.add(events(found.scattering), found.energy);
  table.end_sample();
}

TEST(ClassEnergies, MeansAndErrorsAreThoseOfTheSamples) {
  const Samples samples = random_samples(500);
  ClassEnergies table(Naming::runs, 2);
  std::map<std::string, std::vector<double>> totals;
  for (size_t i = 0; i < samples.size(); ++i) {
    fill(table, samples[i]);
    for (const auto& found : samples[i]) {
      auto& list = totals[name_of(found.scattering, Naming::runs, 2)];
      list.resize(samples.size(), 0);
      list[i] += found.energy;
    }
  }
  const auto rows = table.rows();
  ASSERT_EQ(rows.size(), totals.size());
  double before = INFINITY;
  for (const auto& row : rows) {
    const auto& list = totals.at(row.name);
    double mean = 0, squares = 0;
    uint64_t found = 0;
    for (const double x : list) mean += x / static_cast<double>(list.size()), found += x != 0;
    for (const double x : list) squares += (x - mean) * (x - mean);
    const auto n = static_cast<double>(list.size());
    EXPECT_NEAR(row.mean, mean, 1e-12 * mean);
    EXPECT_NEAR(row.standard_error, std::sqrt(squares / (n - 1) / n), 1e-9 * row.standard_error);
    EXPECT_EQ(row.found, found);
    EXPECT_LE(row.mean, before);
    before = row.mean;
  }
}

TEST(ClassEnergies, MergedInAnyOrderToTheSameBits) {
  const Samples samples = random_samples(400);
  ClassEnergies whole(Naming::words, 3);
  for (const auto& sample : samples) fill(whole, sample);
  for (const size_t threads : {2U, 3U, 7U}) {
    std::vector<ClassEnergies> parts(threads, ClassEnergies(Naming::words, 3));
    for (size_t i = samples.size(); i-- > 0;) fill(parts[i * 5 % threads], samples[i]);
    ClassEnergies merged(Naming::words, 3);
    for (size_t i = threads; i-- > 0;) merged.merge(parts[i]);
    const auto a = whole.rows(), b = merged.rows();
    ASSERT_EQ(merged.samples(), whole.samples());
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].name, b[i].name);
      EXPECT_EQ(std::bit_cast<uint64_t>(a[i].mean), std::bit_cast<uint64_t>(b[i].mean));
      EXPECT_EQ(std::bit_cast<uint64_t>(a[i].standard_error), std::bit_cast<uint64_t>(b[i].standard_error));
      EXPECT_EQ(a[i].found, b[i].found);
    }
  }
}

}  // namespace
}  // namespace etendue::transport
