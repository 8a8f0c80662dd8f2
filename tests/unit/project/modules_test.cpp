// The declared module graph (etendue_module in CMake) against the actual includes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "unit/project/source_tree.h"

namespace etendue::test {
namespace {

using Names = std::set<std::string>;

struct Module {
  std::string folder;
  Names depends, internal;       // declared
  Names in_headers, in_sources;  // included
};

Names names_in(const std::string& list) {
  Names names;
  std::stringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) names.insert(name);
  return names;
}

// From the file that CMake writes: one line per module, name|folder|depends|internal.
std::map<std::string, Module> declared_modules() {
  std::map<std::string, Module> modules;
  std::ifstream in(ETENDUE_MODULE_LIST);
  for (std::string line; std::getline(in, line);) {
    std::stringstream stream(line);
    std::string name, folder, depends, internal;
    std::getline(stream, name, '|');
    std::getline(stream, folder, '|');
    std::getline(stream, depends, '|');
    std::getline(stream, internal, '|');
    if (!name.empty()) modules[name] = {folder, names_in(depends), names_in(internal), {}, {}};
  }
  return modules;
}

// The text between the quotes of `#include "..."`, or nothing.
std::string included(const std::string& line) {
  static const std::regex pattern(R"re(^#include "([^"]+)")re");
  std::smatch match;
  return std::regex_search(line, match, pattern) ? match[1].str() : "";
}

std::string module_of(const std::string& include) { return include.substr(0, include.find('/')); }

std::map<std::string, Module> modules_with_includes() {
  auto modules = declared_modules();
  for (auto& [name, module] : modules)
    for (const SourceFile& file : source_files(module.folder, {".h", ".cpp"}))
      for (const std::string& line : file.lines) {
        const std::string other = module_of(included(line));
        if (other.empty() || other == name || !modules.contains(other)) continue;
        (file.ends_with(".h") ? module.in_headers : module.in_sources).insert(other);
      }
  return modules;
}

std::string text_of(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

Names difference(const Names& a, const Names& b) {
  Names result;
  for (const std::string& name : a)
    if (!b.contains(name)) result.insert(name);
  return result;
}

TEST(Modules, AreDeclared) { EXPECT_GE(declared_modules().size(), 15u); }

TEST(Modules, HeadersIncludeDeclaredDependenciesOnly) {
  for (const auto& [name, module] : modules_with_includes())
    EXPECT_EQ(text_of(difference(module.in_headers, module.depends)), "")
        << "module " << name << ": add these to DEPENDS in its etendue_module(), or do not include them in headers";
}

TEST(Modules, SourcesIncludeDeclaredModulesOnly) {
  for (const auto& [name, module] : modules_with_includes()) {
    Names declared = module.depends;
    declared.insert(module.internal.begin(), module.internal.end());
    EXPECT_EQ(text_of(difference(module.in_sources, declared)), "")
        << "module " << name << ": add these to INTERNAL in its etendue_module(), or do not include them";
  }
}

TEST(Modules, DeclareNothingThatIsUnused) {
  for (const auto& [name, module] : modules_with_includes()) {
    Names used = module.in_headers;
    EXPECT_EQ(text_of(difference(module.depends, used)), "")
        << "module " << name << ": DEPENDS lists modules that no header includes";
    used.insert(module.in_sources.begin(), module.in_sources.end());
    EXPECT_EQ(text_of(difference(module.internal, used)), "") << "module " << name << ": INTERNAL lists unused modules";
    for (const std::string& both : module.internal) EXPECT_FALSE(module.depends.contains(both)) << name << ": " << both;
  }
}

// Strongly connected components with more than one node [Tarjan 1972].
class Cycles {
 public:
  using Graph = std::map<std::string, Names>;
  explicit Cycles(const Graph& graph) : graph_(graph) {
    for (const auto& [node, edges] : graph_)
      if (!index_.contains(node)) visit(node);
  }
  const std::vector<std::string>& found() const { return found_; }

 private:
  void visit(const std::string& node) {
    index_[node] = low_[node] = next_++;
    stack_.push_back(node);
    if (const auto edges = graph_.find(node); edges != graph_.end())
      for (const std::string& to : edges->second) {
        if (!index_.contains(to)) {
          visit(to);
          low_[node] = std::min(low_[node], low_[to]);
        } else if (std::ranges::find(stack_, to) != stack_.end()) {
          low_[node] = std::min(low_[node], index_[to]);
        }
      }
    if (low_[node] != index_[node]) return;
    std::string members;
    size_t size = 0;
    for (std::string member; member != node; ++size) {
      member = stack_.back();
      stack_.pop_back();
      members += member + " ";
    }
    if (size > 1) found_.push_back(members);
  }

  const Graph& graph_;
  std::map<std::string, int> index_, low_;
  std::vector<std::string> stack_, found_;
  int next_ = 0;
};

TEST(Modules, FormNoCycle) {
  Cycles::Graph graph;
  for (const auto& [name, module] : modules_with_includes()) {
    graph[name] = module.in_headers;
    graph[name].insert(module.in_sources.begin(), module.in_sources.end());
  }
  const Cycles cycles(graph);
  for (const std::string& cycle : cycles.found()) ADD_FAILURE() << "modules include each other: " << cycle;
}

// Whether `to` is reachable from `from` by at least one edge.
bool reaches(const Cycles::Graph& graph, const std::string& from, const std::string& to) {
  const auto edges = graph.find(from);
  if (edges == graph.end()) return false;
  return std::ranges::any_of(edges->second,
                             [&](const std::string& next) { return next == to || reaches(graph, next, to); });
}

// The edges that do not follow from others, as "from->to".
Names reduced_edges(const Cycles::Graph& graph) {
  Names edges;
  for (const auto& [from, targets] : graph)
    for (const std::string& to : targets) {
      const bool follows = std::ranges::any_of(
          targets, [&](const std::string& other) { return other != to && reaches(graph, other, to); });
      if (!follows) edges.insert(from + "->" + to);
    }
  return edges;
}

TEST(Modules, PictureShowsTheDeclaredGraph) {
  Cycles::Graph graph;
  for (const auto& [name, module] : declared_modules()) {
    graph[name] = module.depends;
    graph[name].insert(module.internal.begin(), module.internal.end());
  }
  std::ifstream in(source_root() / "docs/images/modules.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  Names drawn;
  const std::regex pattern("<title>(\\w+)&#45;&gt;(\\w+)</title>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it)
    drawn.insert((*it)[1].str() + "->" + (*it)[2].str());
  EXPECT_EQ(drawn, reduced_edges(graph)) << "run tools/module_graph.sh";
}

// Units that are allowed to be part of a cycle, because a registry lists what in turn uses the registry's types.
bool is_registry(const std::string& unit) {
  return unit.ends_with("registry") || unit.ends_with("builtin/builtin") || unit.ends_with("all_lobe_types") ||
         unit.ends_with("all_lobes");
}

// A header and its .cpp count as one unit: the .cpp of A may not include B if B includes A.
TEST(Modules, FilesOfOneModuleFormNoCycle) {
  for (const auto& [name, module] : declared_modules()) {
    const auto files = source_files(module.folder, {".h", ".cpp"});
    const std::string base = module.folder.substr(0, module.folder.size() - name.size());
    Cycles::Graph graph;
    for (const SourceFile& file : files)
      for (const std::string& line : file.lines) {
        const std::string include = included(line);
        if (module_of(include) != name || is_registry(file.unit())) continue;
        const std::string unit = base + include.substr(0, include.rfind('.'));
        if (unit != file.unit() && !is_registry(unit)) graph[file.unit()].insert(unit);
      }
    const Cycles cycles(graph);
    for (const std::string& cycle : cycles.found()) ADD_FAILURE() << "files include each other: " << cycle;
  }
}

// The core must not depend on the viewer, the command line or a graphics library.
TEST(Modules, TheCoreAndTheLabIncludeNoUserInterface) {
  const std::regex forbidden(R"re(#include [<"](imgui|GLFW|GL/|EGL|GLES|glad|osmesa|viewer/|cli/))re");
  for (const char* folder : {"core", "lab"})
    for (const SourceFile& file : source_files(folder, {".h", ".cpp"}))
      for (const std::string& line : file.lines)
        EXPECT_FALSE(std::regex_search(line, forbidden)) << file.path << ": " << line;
}

}  // namespace
}  // namespace etendue::test
