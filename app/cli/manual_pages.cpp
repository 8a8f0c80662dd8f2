#include "manual_pages.h"

#include <algorithm>
#include <sstream>

#include "base/number_text.h"
#include "bsdf/bsdf_model.h"
#include "command.h"
#include "experiments/experiment.h"
#include "figures/figure.h"
#include "integrator/integrator.h"
#include "light/environments/builtin_environment.h"
#include "light/light.h"
#include "man_page.h"
#include "medium/phase_function.h"
#include "render/document.h"
#include "sampling/sampler.h"
#include "scene/builtin/builtin.h"
#include "section_infos.h"
#include "stress/case.h"

namespace etendue::cli {
namespace {

constexpr const char* kReferences = "../../references.md";

// A sentence with a full stop.
std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string plain(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return format_number(*number, 6);
  return to_string(value);
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string table_code(std::string text) {
  for (size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, "\\");
  return code(text);
}

// The allowed values of a parameter.
std::string allowed_values(const ParameterInfo& p) {
  if (p.type == ParameterType::integer || p.type == ParameterType::number)
    return format_number(p.min, 6) + " to " + format_number(p.max, 6);
  std::string text;
  for (const auto& option : p.options) text += (text.empty() ? "" : ", ") + code(option);
  return text.empty() ? code("true") + ", " + code("false") : text;
}

std::string parameter_table(const std::vector<ParameterInfo>& parameters) {
  if (parameters.empty()) return "";
  std::string text = "## Parameters\n\n| Name | Meaning | Values | Default | Unit |\n|---|---|---|---|---|\n";
  for (const auto& p : parameters)
    text += "| " + code(p.name) + " | " + p.label + ": " + markdown_prose(sentence(p.doc), kReferences) + " | " +
            allowed_values(p) + " | " + code(plain(p.default_value)) + " | " + p.unit + " |\n";
  return text + "\n";
}

// Rows of a two-column table; rows without a value are omitted.
class PropertyTable {
 public:
  void add(const char* name, const std::string& value) {
    if (!value.empty()) rows_ += "| " + std::string(name) + " | " + value + " |\n";
  }
  // Prose, unless the head comment has a paragraph of this label.
  void add_unless(const HeadComment& head, const char* name, const char* text) {
    if (!head.labels.contains(name)) add(name, markdown_prose(text, kReferences));
  }
  std::string text() const { return rows_.empty() ? "" : "| | |\n|---|---|\n" + rows_ + "\n"; }

 private:
  std::string rows_;
};

std::string code_block(const std::string& text) {
  std::string block;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) block += "    " + line + "\n";
  return block.empty() ? "" : block + "\n";
}

std::string title(const std::string& label, const std::string& summary) {
  return "# " + label + "\n\n" + markdown_prose(sentence(summary), kReferences) + "\n\n";
}

std::string image(const std::string& folder, const std::string& name, const std::string& label) {
  return "![" + label + "](../images/" + folder + "-" + name + ".png)\n\n";
}

std::string source_line(const SourceFiles& sources, const std::string& file) {
  return "Source: " + code(sources.relative_path(file)) + "\n";
}

// ---- Integrators

bool refers_to_integrator(const std::string& source, const integrator::IntegratorInfo& info) {
  if (source.find("\"" + info.name + "\"") != std::string::npos) return true;
  if (source.find("\"" + info.name + ":") != std::string::npos) return true;
  static const auto unbiased = stress::unbiased_integrators();
  return source.find("unbiased_integrators()") != std::string::npos && std::ranges::count(unbiased, info.name) > 0;
}

std::string case_file(const stress::Case& c) {
  std::string file = c.name;
  std::ranges::replace(file, '-', '_');
  return file + ".h";
}

std::string stress_case_list(const SourceFiles& sources, const integrator::IntegratorInfo& info) {
  std::string text;
  for (const auto& c : stress::cases())
    if (refers_to_integrator(sources.text(case_file(c)), info))
      text += "- [" + std::string(c.name) + "](../stress/" + c.name +
              ".md): " + markdown_prose(sentence(c.theory), kReferences) + "\n";
  return text.empty() ? "" : "## Stability cases\n\n" + text + "\n";
}

// How a rendering divides into parts that etendue merge joins.
std::string division_text(const integrator::Division& division) {
  if (division.unit == integrator::DivisionUnit::none) return "nothing. " + division.reason;
  return (division.regions ? "samples and regions. " : "samples. ") + division.reason;
}

ManualPage integrator_page(const SourceFiles& sources, const integrator::IntegratorInfo& info) {
  const HeadComment head = sources.head_comment(info.file);
  PropertyTable properties;
  properties.add("Name", code(info.name));
  properties.add("Family", integrator::info_of(info.group).label);
  properties.add("Light paths", table_code(info.paths));
  properties.add("Light paths of point, spot and directional lights",
                 info.point_paths.empty() ? "none" : table_code(info.point_paths));
  properties.add("Bias", std::string(integrator::bias_name(info.bias)));
  properties.add("Cost", markdown_prose(info.cost, kReferences));
  properties.add("Known limitations", markdown_prose(info.limitations, kReferences));
  properties.add("Divides into", division_text(info.division));
  return {"integrators/" + info.name + ".md", title(info.label, info.summary) +
                                                  image("integrator", info.name, info.label) + properties.text() +
                                                  "## Method\n\n" + head.markdown + parameter_table(info.parameters) +
                                                  stress_case_list(sources, info) + source_line(sources, info.file)};
}

// ---- Samplers

ManualPage sampler_page(const SourceFiles& sources, const SamplerInfo& info) {
  PropertyTable properties;
  properties.add("Name", code(info.name));
  properties.add("Samples", info.independent ? "statistically independent" : "stratified or low-discrepancy");
  properties.add("Progressive", info.progressive ? "yes" : "no: whole groups of samples are distributed evenly");
  properties.add("Dimensions distributed evenly together", std::to_string(info.joint_dimensions));
  properties.add("Further dimensions", info.padding);
  return {"samplers/" + info.name + ".md", title(info.label, info.doc) + image("sampler", info.name, info.label) +
                                               properties.text() + "## Method\n\n" +
                                               sources.head_comment(info.file).markdown +
                                               parameter_table(info.parameters) + source_line(sources, info.file)};
}

// ---- Surfaces

std::string preset_table(const std::vector<ModelPreset>& presets) {
  if (presets.empty()) return "";
  std::string text = "## Presets\n\n| Name | Label | Values | Source |\n|---|---|---|---|\n";
  for (const auto& preset : presets) {
    std::string values;
    for (const auto& [name, value] : preset.values)
      values += (values.empty() ? "" : ", ") + code(name + " = " + plain(value));
    text += "| " + code(preset.name) + " | " + preset.label + " | " + values + " | " +
            markdown_prose(preset.source, kReferences) + " |\n";
  }
  return text + "\n";
}

ManualPage surface_page(const SourceFiles& sources, const BsdfModelInfo& info) {
  const BsdfModelDescription& model = info.description;
  const HeadComment head = sources.head_comment(model.file);
  PropertyTable properties;
  properties.add("Name", code(model.name));
  properties.add("Class", Options<ModelClass>::kOptions[static_cast<size_t>(model.model_class)].label);
  properties.add_unless(head, "Properties", model.properties);
  properties.add_unless(head, "Sampling", model.sampling);
  properties.add_unless(head, "Limitations", model.limitations);
  properties.add("References", markdown_prose(model.source, kReferences));
  return {std::string("surfaces/") + model.name + ".md",
          title(model.label, model.summary) + image("surface", model.name, model.label) + properties.text() +
              "## Model\n\n" + (head.has_formula ? "" : code_block(model.formula)) + head.markdown +
              parameter_table(info.parameters) + preset_table(info.presets) + source_line(sources, model.file)};
}

ManualPage gltf_surface_page(const SourceFiles& sources) {
  return {"surfaces/gltf.md", title("glTF surface", "The metallic-roughness material of glTF 2.0 with its extensions") +
                                  image("surface", "gltf", "glTF surface") + "## Model\n\n" +
                                  sources.head_comment("gltf_surface.h").markdown +
                                  parameter_table(section_infos(sample_document(), "material.0")) +
                                  source_line(sources, "gltf_surface.h")};
}

// ---- Media

ManualPage phase_page(const SourceFiles& sources, const PhaseFunctionInfo& info) {
  const PhaseFunctionDescription& phase = info.description;
  PropertyTable properties;
  properties.add("Name", code(phase.name));
  properties.add("Mean cosine", phase.mean_cosine);
  properties.add("Sampling", phase.sampling);
  properties.add("Limitations", phase.limitations);
  properties.add("References", markdown_prose(phase.source, kReferences));
  return {std::string("phase-functions/") + phase.name + ".md",
          title(phase.label, phase.summary) + properties.text() + "## Model\n\n" + code_block(phase.formula) +
              sources.head_comment(phase.file).markdown + parameter_table(info.parameters) +
              source_line(sources, phase.file)};
}

ManualPage density_page(const SourceFiles& sources, const DensityInfo& info) {
  const DensityDescription& density = info.description;
  PropertyTable properties;
  properties.add("Name", code(density.name));
  properties.add("Limitations", density.limitations);
  properties.add("References", markdown_prose(density.source, kReferences));
  return {std::string("densities/") + density.name + ".md",
          title(density.label, density.summary) + properties.text() + "## Model\n\n" + code_block(density.formula) +
              sources.head_comment(density.file).markdown + parameter_table(info.parameters) +
              source_line(sources, density.file)};
}

// ---- Lights, cameras, scenes

ManualPage light_page(const SourceFiles& sources, const LightTypeInfo& info) {
  const LightTypeDescription& type = info.description;
  const HeadComment head = sources.head_comment(type.file);
  PropertyTable properties;
  properties.add("Name", code(type.name));
  properties.add("Class", Options<LightClass>::kOptions[static_cast<size_t>(type.light_class)].label);
  properties.add("Quantity of the intensity", std::string(type.quantity->name) + ", " + type.quantity->unit);
  properties.add("In glTF", type.punctual ? "KHR_lights_punctual" : "ETENDUE_transport");
  properties.add_unless(head, "Sampling", type.sampling);
  properties.add("References", markdown_prose(type.source, kReferences));
  return {std::string("lights/") + type.name + ".md",
          title(type.label, type.summary) + image("light", type.name, type.label) + properties.text() + "## Model\n\n" +
              code_block(type.formula) + head.markdown + parameter_table(info.parameters) +
              source_line(sources, type.file)};
}

ManualPage environment_page(const SourceFiles& sources, const BuiltinEnvironment& environment) {
  const std::string file = std::string(environment.name) + ".h";
  return {std::string("environments/") + environment.name + ".md",
          title(environment.label, environment.doc) + image("environment", environment.name, environment.label) +
              "## Model\n\n" + sources.head_comment(file).markdown + "Select it with " +
              code(std::string("--env ") + environment.name) + ", or in the *Light* panel.\n\n" +
              source_line(sources, file)};
}

ManualPage camera_page(const SourceFiles& sources, const std::string& name, const std::string& label) {
  const render::Document document = *render::with_text(sample_document(), "camera.projection", name);
  const std::string file = name + ".h";
  return {"cameras/" + name + ".md", title(label, label + " projection") + image("camera", name, label) +
                                         "## Model\n\n" + sources.head_comment(file).markdown +
                                         parameter_table(section_infos(document, "camera")) +
                                         source_line(sources, file)};
}

std::vector<ManualPage> camera_pages(const SourceFiles& sources) {
  const std::vector<ParameterInfo> parameters = section_infos(sample_document(), "camera");
  const ParameterInfo& projection = *find_parameter(parameters, "projection");
  std::vector<ManualPage> pages;
  for (size_t i = 0; i < projection.options.size(); ++i)
    pages.push_back(camera_page(sources, projection.options[i], projection.option_labels[i]));
  return pages;
}

ManualPage scene_page(const scene::Builtin& builtin) {
  const scene::Scene scene = builtin.make();
  PropertyTable properties;
  properties.add("Name", code(builtin.name));
  properties.add("Objects", std::to_string(scene.nodes.size()));
  properties.add("Materials", std::to_string(scene.materials.size()));
  properties.add("Lights", std::to_string(scene.lights.size()));
  return {std::string("scenes/") + builtin.name + ".md",
          title(builtin.label, builtin.doc) + image("scene", builtin.name, builtin.label) + properties.text() +
              "Open it with " + code(std::string("etendue view ") + builtin.name) + ".\n"};
}

// ---- Stability cases

ManualPage stress_page(const SourceFiles& sources, const stress::Case& c) {
  PropertyTable properties;
  properties.add("Name", code(c.name));
  properties.add("Kind", std::string(stress::kind_label(c.kind)));
  std::string integrators;
  for (const auto& info : integrator::integrator_infos())
    if (refers_to_integrator(sources.text(case_file(c)), info))
      integrators += (integrators.empty() ? "" : ", ") + ("[" + info.label + "](../integrators/" + info.name + ".md)");
  properties.add("Integrators", integrators);
  return {std::string("stress/") + c.name + ".md",
          title(c.name, c.theory) +
              (sources.has_file(std::string("docs/manual/images/stress-") + c.name + ".png")
                   ? image("stress", c.name, c.name)
                   : "") +
              properties.text() + "## Case\n\n" + sources.head_comment(case_file(c)).markdown + "Run it with " +
              code(std::string("etendue stress ") + c.name) + ".\n\n" + source_line(sources, case_file(c))};
}

// ---- Experiments

ManualPage experiment_page(const SourceFiles& sources, const experiments::Experiment& experiment) {
  const experiments::ExperimentDescription& d = experiment.description;
  PropertyTable properties;
  properties.add("Name", code(d.name));
  properties.add("References", markdown_prose(d.source, kReferences));
  return {std::string("experiments/") + d.name + ".md",
          title(d.label, d.summary) + image("experiment", d.name, d.label) + properties.text() + "## Method\n\n" +
              sources.head_comment(d.file).markdown + parameter_table(experiment.parameters) + "Run it with " +
              code(std::string("etendue lab ") + d.name) + ", or in the panel *Lab*.\n\n" +
              source_line(sources, d.file)};
}

// ---- Figures

std::string chapter_of(std::string_view figure_number) {
  return std::string(figure_number.substr(0, figure_number.find('.')));
}

std::string figure_section(const figures::Figure& figure) {
  const std::string heading = std::string(figure.number) + " " + figure.title;
  return "## " + heading + "\n\n" + image("figure", figure.number, heading) +
         (*figure.note != '\0' ? markdown_prose(figure.note, kReferences) + "\n\n" : "");
}

// The figures of a chapter that are not made, by reason.
std::string missing_figures(const std::string& chapter) {
  std::string text;
  for (const auto reason : {figures::Reason::artwork, figures::Reason::pseudocode, figures::Reason::diagram}) {
    std::string numbers;
    for (const auto& figure : figures::not_made())
      if (figure.reason == reason && chapter_of(figure.number) == chapter)
        numbers += (numbers.empty() ? "" : ", ") + std::string(figure.number);
    if (!numbers.empty()) text += "| " + numbers + " | " + figures::explanation(reason) + " |\n";
  }
  return text.empty() ? "" : "## Figures that are not made\n\n| Figures | Reason |\n|---|---|\n" + text + "\n";
}

std::vector<ManualPage> figure_pages() {
  std::vector<ManualPage> pages;
  std::vector<std::string> chapters;
  const auto add_chapter = [&](std::string_view number) {
    if (std::ranges::count(chapters, chapter_of(number)) == 0) chapters.push_back(chapter_of(number));
  };
  for (const auto& figure : figures::figures()) add_chapter(figure.number);
  for (const auto& figure : figures::not_made()) add_chapter(figure.number);
  for (const std::string& chapter : chapters) {
    const bool is_appendix = chapter == "A";
    std::string text = title(is_appendix ? "Figures of the appendix" : "Figures of chapter " + chapter,
                             "The figures of [Lang] that the program makes");
    text += "`etendue figure NUMBER` makes a figure, `etendue figure --all --out FOLDER` all of them.\n\n";
    for (const auto& figure : figures::figures())
      if (chapter_of(figure.number) == chapter) text += figure_section(figure);
    pages.push_back({"figures/" + (is_appendix ? std::string("appendix") : "chapter-" + chapter) + ".md",
                     text + missing_figures(chapter)});
  }
  return pages;
}

// ---- Command line

std::string bounds_text(const CommandOption& option) {
  std::string text;
  for (const auto& choice : option.choices) text += (text.empty() ? " One of " : ", ") + code(choice);
  if (!text.empty()) text += ".";
  if (option.bounds.kind == Bounds::Kind::range)
    text += " " + format_number(option.bounds.min, 6) + " to " + format_number(option.bounds.max, 6) + ".";
  if (option.bounds.kind == Bounds::Kind::positive) text += " Positive.";
  return text;
}

ManualPage command_line_page() {
  std::string text =
      "# Command line\n\nAll subcommands and their options. `etendue COMMAND --help` prints the same.\n\n";
  for (const Command& command : commands()) {
    text += "## etendue " + command.name + "\n\n" + sentence(command.summary) + "\n\n";
    text += "| Option | Meaning |\n|---|---|\n";
    for (const CommandOption& option : command.options)
      text += "| " + code(option.names) + " | " + (option.required ? "Required. " : "") +
              markdown_prose(sentence(option.doc), "../references.md") + bounds_text(option) + " |\n";
    text += "\n";
  }
  return {"command-line.md", text};
}

// ---- Index

struct Chapter {
  const char* folder;
  const char* label;
};
constexpr Chapter kChapters[] = {{"integrators", "Integrators"},
                                 {"samplers", "Samplers"},
                                 {"surfaces", "Surfaces"},
                                 {"phase-functions", "Phase functions"},
                                 {"densities", "Densities of media"},
                                 {"lights", "Lights"},
                                 {"environments", "Environments"},
                                 {"cameras", "Cameras"},
                                 {"scenes", "Built-in scenes"},
                                 {"stress", "Stability cases"},
                                 {"experiments", "Experiments"},
                                 {"figures", "Figures"}};

// The title of a page and the paragraph below it.
std::string index_line(const ManualPage& page) {
  const size_t end = page.text.find('\n');
  const size_t summary = end + 2, summary_end = page.text.find('\n', summary);
  std::string line = "- [" + page.text.substr(2, end - 2) + "](" + page.file +
                     "): " + page.text.substr(summary, summary_end - summary) + "\n";
  for (size_t i = line.find("../../"); i != std::string::npos; i = line.find("../../")) line.erase(i, 3);
  return line;
}

ManualPage index_page(const std::vector<ManualPage>& pages) {
  std::string text =
      "# Manual\n\n"
      "These pages are generated from the program and its sources by `tools/update_manual.sh`; do not edit them.\n\n"
      "- [Command line](command-line.md): All subcommands and their options.\n\n";
  for (const Chapter& chapter : kChapters) {
    text += "## " + std::string(chapter.label) + "\n\n";
    for (const auto& page : pages)
      if (page.file.starts_with(std::string(chapter.folder) + "/")) text += index_line(page);
    text += "\n";
  }
  return {"index.md", text};
}

}  // namespace

std::vector<ManualPage> manual_pages(const SourceFiles& sources) {
  std::vector<ManualPage> pages;
  for (const auto& info : integrator::integrator_infos()) pages.push_back(integrator_page(sources, info));
  for (const auto& info : sampler_infos()) pages.push_back(sampler_page(sources, info));
  pages.push_back(gltf_surface_page(sources));
  for (const auto& info : bsdf_model_infos()) pages.push_back(surface_page(sources, info));
  for (const auto& info : phase_function_infos()) pages.push_back(phase_page(sources, info));
  for (const auto& info : density_infos()) pages.push_back(density_page(sources, info));
  for (const auto& info : light_type_infos()) pages.push_back(light_page(sources, info));
  for (const auto& environment : builtin_environments()) pages.push_back(environment_page(sources, environment));
  std::ranges::move(camera_pages(sources), std::back_inserter(pages));
  for (const auto& builtin : scene::builtins()) pages.push_back(scene_page(builtin));
  for (const auto& c : stress::cases()) pages.push_back(stress_page(sources, c));
  for (const auto& e : experiments::experiments()) pages.push_back(experiment_page(sources, e));
  std::ranges::move(figure_pages(), std::back_inserter(pages));
  pages.push_back(index_page(pages));
  pages.push_back(command_line_page());
  pages.push_back({"etendue.1", man_page()});
  return pages;
}

}  // namespace etendue::cli
